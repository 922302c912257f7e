// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/slab_insulated.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_slab_insulated)

using namespace sphverify::exact;
using namespace sphverify::tests;

constexpr double mean = 1.3;
constexpr double conductivity = 1.7;
constexpr double density = 0.6;

std::vector<Mode> const modes{{1, 0.5}, {2, 0.4}, {4, -0.3}};

SlabInsulated slab() { return SlabInsulated(mean, modes, conductivity, density); }

// Space step 0.004: truncation below 1e-8 for mode 4, rounding below 1e-9; time step 2e-5: both below 1e-9.
BOOST_AUTO_TEST_CASE(temperature_solves_the_heat_equation) {
  SlabInsulated const exact = slab();
  for (double const t : {0.001, 0.004, 0.02, 0.1}) {
    for (double x = 0.05; x < 1.0; x += 0.06) {
      double const rate = first_derivative([&](double s) { return exact.temperature(x, s); }, t, 2e-5);
      double const curvature = second_derivative([&](double s) { return exact.temperature(s, t); }, x, 0.004);
      BOOST_TEST(std::abs(density * rate - conductivity * curvature) < 1e-7, "x = " << x << ", t = " << t);
    }
  }
}

BOOST_AUTO_TEST_CASE(no_heat_crosses_the_walls) {
  SlabInsulated const exact = slab();
  for (double const t : {0.0, 0.01, 1.0}) {
    for (double const wall : {0.0, 1.0}) {
      BOOST_TEST(std::abs(exact.gradient(wall, t)) < 1e-14);
      double const slope = first_derivative([&](double x) { return exact.temperature(x, t); }, wall, 0.002);
      BOOST_TEST(std::abs(slope) < 1e-10);
    }
  }
}

BOOST_AUTO_TEST_CASE(mean_temperature_is_conserved) {
  SlabInsulated const exact = slab();
  for (double const t : {0.0, 0.01, 0.1}) {
    BOOST_TEST(std::abs(integral([&](double x) { return exact.temperature(x, t); }, 0.0, 1.0) - mean) <
               1e-13);
  }
}

BOOST_AUTO_TEST_CASE(initial_state_holds_each_amplitude_in_its_own_mode) {
  SlabInsulated const exact = slab();
  for (int n = 1; n <= 5; ++n) {
    double const projection =
        2.0 *
        integral([&](double x) { return exact.temperature(x, 0.0) * std::cos(n * std::numbers::pi * x); },
                 0.0, 1.0);
    double amplitude = 0.0;
    for (Mode const& mode : modes) amplitude += mode.number == n ? mode.amplitude : 0.0;
    BOOST_TEST(std::abs(projection - amplitude) < 1e-12, "mode " << n);
  }
}

BOOST_AUTO_TEST_CASE(late_state_is_the_mean) {
  BOOST_TEST(std::abs(slab().temperature(0.25, 10.0) - mean) <= slab().accuracy());
}

BOOST_AUTO_TEST_CASE(gradient_is_the_derivative_of_the_temperature) {
  SlabInsulated const exact = slab();
  for (double const t : {0.0, 0.01}) {
    for (double const x : {0.0, 0.13, 0.5, 0.77, 1.0}) {
      double const expected = first_derivative([&](double s) { return exact.temperature(s, t); }, x, 0.002);
      BOOST_TEST(std::abs(exact.gradient(x, t) - expected) < 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(temperature_is_as_accurate_as_promised) {
  SlabInsulated const exact = slab();
  BOOST_TEST(exact.accuracy() < 1e-13);
  constexpr long double pi = std::numbers::pi_v<long double>;
  for (double t = 0.0; t < 0.2; t += 0.013) {
    for (double x = 0.0; x <= 1.0; x += 0.0173) {
      long double sum = mean;
      for (Mode const& mode : modes) {
        long double const k = mode.number * pi;
        sum += mode.amplitude * std::cos(k * x) * std::exp(-k * k * conductivity / density * t);
      }
      BOOST_TEST(std::abs(static_cast<double>(exact.temperature(x, t) - sum)) <= exact.accuracy());
    }
  }
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(refuses([] { SlabInsulated(1, {}, -1, 1); }, "conductivity must be positive, found -1"));
  BOOST_TEST(refuses([] { SlabInsulated(1, {}, 1, 0); }, "density must be positive, found 0"));
  BOOST_TEST(refuses([] { SlabInsulated(1, {{-2, 1}}, 1, 1); }, "mode number must be 1 or more, found -2"));
  double const nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_THROW(SlabInsulated(nan, {}, 1, 1), std::invalid_argument);
  BOOST_CHECK_THROW(SlabInsulated(1, {{1, nan}}, 1, 1), std::invalid_argument);
  BOOST_TEST(refuses([] { slab().temperature(0.5, -1.0); }, "time must be zero or positive, found -1"));
  BOOST_CHECK_THROW(slab().gradient(0.5, -1.0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
