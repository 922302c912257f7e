// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/two_layer.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_two_layer)

using namespace sphverify::exact;
using namespace sphverify::tests;

constexpr double left = 1.0;
constexpr double right = 2.0;
constexpr double contrasts[] = {1e-8, 1e-3, 0.3, 1.0, 1.0000001, 2.0, 40.0, 1e4, 1e8, 1e12};

TwoLayer layers(double contrast) { return TwoLayer(left, right, contrast, 0.7); }

double just_left() { return std::nextafter(0.5, 0.0); }

/// A time in which the mode decays much but not all.
double late(TwoLayer const& exact) { return 0.6 / exact.decay_rate(); }

BOOST_AUTO_TEST_CASE(phase_satisfies_the_equation_of_the_slowest_mode) {
  for (double const contrast : contrasts) {
    TwoLayer const exact = layers(contrast);
    double const S = std::sqrt(std::max(contrast, 1.0 / contrast));
    double const theta = exact.phase();
    BOOST_TEST((theta >= 0.5 * std::numbers::pi * (1.0 - 1e-15) && theta < std::numbers::pi));
    // As large as what rounding theta by one unit makes of it, with the slope S + 1/S of its terms.
    double const residual = std::cos(theta) * std::sin(theta / S) + S * std::sin(theta) * std::cos(theta / S);
    BOOST_TEST(std::abs(residual) < 1e-15 * (S + 1.0), "contrast " << contrast);
  }
}

BOOST_AUTO_TEST_CASE(no_mode_is_slower) {
  for (double const contrast : {1.0, 3.0, 100.0, 1e6}) {
    double const S = std::sqrt(contrast);
    double const theta = layers(contrast).phase();
    for (double part = 0.01; part < 0.99; part += 0.01) {
      double const s = part * theta;  // before the first zero all is positive
      BOOST_TEST(std::cos(s) * std::sin(s / S) + S * std::sin(s) * std::cos(s / S) > 0.0);
    }
  }
}

BOOST_AUTO_TEST_CASE(equal_layers_are_a_uniform_slab) {
  TwoLayer const exact = layers(1.0);
  BOOST_TEST(exact.decay_rate() == std::numbers::pi * std::numbers::pi, boost::test_tools::tolerance(1e-14));
  for (double x = 0.0; x <= 1.0; x += 0.09) {
    double const expected =
        1.0 + x +
        0.7 * std::sin(std::numbers::pi * x) * std::exp(-0.03 * std::numbers::pi * std::numbers::pi);
    BOOST_TEST(std::abs(exact.temperature(x, 0.03) - expected) <= exact.accuracy());
  }
}

BOOST_AUTO_TEST_CASE(a_perfect_conductor_is_as_good_as_a_wall) {
  TwoLayer const exact = layers(1e14);
  double const expected = 4.0 * std::numbers::pi * std::numbers::pi;
  BOOST_TEST(exact.decay_rate() == expected, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(std::abs(exact.temperature(0.5, 0.0) - right) < 1e-6);
}

BOOST_AUTO_TEST_CASE(each_layer_solves_its_own_equation) {
  for (double const contrast : {1e-3, 0.3, 1.0, 2.0, 40.0, 1e4}) {
    TwoLayer const exact = layers(contrast);
    double const t = late(exact);
    double const dt = 0.01 * t;
    for (double const x : {0.05, 0.21, 0.4, 0.48, 0.52, 0.6, 0.85, 0.93}) {
      double const rate = first_derivative([&](double s) { return exact.temperature(x, s); }, t, dt);
      double const divergence = first_derivative([&](double s) { return exact.flux(s, t); }, x, 0.004);
      BOOST_TEST(std::abs(rate + divergence) < 1e-9 * exact.decay_rate(),
                 "contrast " << contrast << ", x = " << x);
    }
  }
}

BOOST_AUTO_TEST_CASE(flux_is_minus_conductivity_times_the_slope_of_the_temperature) {
  for (double const contrast : {1e-3, 0.3, 2.0, 40.0}) {
    TwoLayer const exact = layers(contrast);
    for (double const x : {0.1, 0.3, 0.45, 0.55, 0.8}) {
      double const slope =
          first_derivative([&](double s) { return exact.temperature(s, late(exact)); }, x, 0.004);
      BOOST_TEST(std::abs(exact.gradient(x, late(exact)) - slope) < 1e-9);
      BOOST_TEST(exact.flux(x, late(exact)) == -(x < 0.5 ? 1.0 : contrast) * exact.gradient(x, late(exact)));
    }
  }
}

BOOST_AUTO_TEST_CASE(temperature_and_flux_are_continuous_where_the_layers_meet) {
  for (double const contrast : contrasts) {
    TwoLayer const exact = layers(contrast);
    for (double const t : {0.0, late(exact), 50.0 / exact.decay_rate()}) {
      BOOST_TEST(std::abs(exact.temperature(just_left(), t) - exact.temperature(0.5, t)) <= exact.accuracy());
      double const flux = exact.flux(0.5, t);
      BOOST_TEST(std::abs(exact.flux(just_left(), t) - flux) < 1e-13 * std::min(1.0, contrast),
                 "contrast " << contrast << ", t = " << t << ": " << flux);
    }
  }
}

BOOST_AUTO_TEST_CASE(walls_keep_their_temperatures) {
  for (double const contrast : contrasts) {
    TwoLayer const exact = layers(contrast);
    for (double const t : {0.0, late(exact)}) {
      BOOST_TEST(std::abs(exact.temperature(0.0, t) - left) <= exact.accuracy());
      BOOST_TEST(std::abs(exact.temperature(1.0, t) - right) <= exact.accuracy());
    }
  }
}

BOOST_AUTO_TEST_CASE(late_flux_is_that_of_two_resistances_in_series) {
  for (double const contrast : contrasts) {
    TwoLayer const exact = layers(contrast);
    double const expected = -(right - left) / (0.5 + 0.5 / contrast);
    for (double const x : {0.1, 0.7})
      BOOST_TEST(exact.flux(x, 100.0 / exact.decay_rate()) == expected, boost::test_tools::tolerance(1e-14));
  }
}

/// Finite volumes with the harmonic mean at faces, marched by the trapezoidal rule: a route without modes.
class FiniteVolumes {
 public:
  FiniteVolumes(double contrast, int cells)
      : width_(1.0 / cells), resistance_(static_cast<std::size_t>(cells) + 1) {
    auto const half = [&](int c) { return 0.5 * width_ / (2 * c < cells ? 1.0 : contrast); };
    for (int f = 0; f <= cells; ++f)
      resistance_[static_cast<std::size_t>(f)] = (f > 0 ? half(f - 1) : 0.0) + (f < cells ? half(f) : 0.0);
  }

  double centre(std::size_t c) const { return (static_cast<double>(c) + 0.5) * width_; }

  void step(std::vector<double>& T, double dt) const {
    std::size_t const n = T.size();
    double const a = 0.5 * dt / width_;
    std::vector<double> diagonal(n), above(n), next(n);
    for (std::size_t c = 0; c < n; ++c) {
      double const lower = c > 0 ? T[c - 1] : left;
      double const upper = c + 1 < n ? T[c + 1] : right;
      double const l = a / resistance_[c];
      double const u = a / resistance_[c + 1];
      diagonal[c] = 1.0 + l + u;
      above[c] = -u;
      next[c] = T[c] + l * (lower - T[c]) + u * (upper - T[c]);
      if (c == 0) next[c] += l * left;
      if (c + 1 == n) next[c] += u * right;
    }
    for (std::size_t c = 1; c < n; ++c) {
      double const factor = above[c - 1] / diagonal[c - 1];  // the matrix is symmetric
      diagonal[c] -= factor * above[c - 1];
      next[c] -= factor * next[c - 1];
    }
    for (std::size_t c = n; c-- > 0;)
      T[c] = (next[c] - (c + 1 < n ? above[c] * T[c + 1] : 0.0)) / diagonal[c];
  }

 private:
  double width_;
  std::vector<double> resistance_;
};

BOOST_AUTO_TEST_CASE(temperature_agrees_with_finite_volumes) {
  for (double const contrast : {0.02, 1.0, 5.0, 100.0, 1e6}) {
    TwoLayer const exact = layers(contrast);
    double const end = late(exact);
    double error[2];
    for (int level = 0; level < 2; ++level) {
      int const cells = level == 0 ? 100 : 200;
      FiniteVolumes const volumes(contrast, cells);
      std::vector<double> T(static_cast<std::size_t>(cells));
      for (std::size_t c = 0; c < T.size(); ++c) T[c] = exact.temperature(volumes.centre(c), 0.0);
      int const steps = 4 * cells;
      for (int k = 0; k < steps; ++k) volumes.step(T, end / steps);
      error[level] = 0.0;
      for (std::size_t c = 0; c < T.size(); ++c)
        error[level] = std::max(error[level], std::abs(T[c] - exact.temperature(volumes.centre(c), end)));
    }
    BOOST_TEST_MESSAGE("contrast " << contrast << ": " << error[0] << " " << error[1]);
    BOOST_TEST(error[0] < 3e-4);
    BOOST_TEST(error[1] < 0.3 * error[0]);  // second order, and to nothing else
  }
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(refuses([] { layers(0.0); }, "contrast must be positive, found 0"));
  BOOST_TEST(refuses([] { layers(2.0).temperature(0.5, -1.0); }, "time must be zero or positive, found -1"));
  double const nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_THROW(layers(nan), std::invalid_argument);
  BOOST_CHECK_THROW(TwoLayer(nan, 1, 2, 1), std::invalid_argument);
  BOOST_CHECK_THROW(TwoLayer(1, nan, 2, 1), std::invalid_argument);
  BOOST_CHECK_THROW(TwoLayer(1, 2, 2, nan), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
