// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/cold_front.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "cases/exact/marshak.hpp"
#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_cold_front)

using namespace sphverify::exact;
using namespace sphverify::tests;

BOOST_AUTO_TEST_CASE(constant_conductivity_gives_the_error_function) {
  for (double const cold : {0.5, 0.01, 1e-6, 1e-12}) {
    ColdFront const exact(0.0, cold, 1.0);
    for (double x = 0.0; x < 12.0; x += 0.0137) {
      double const expected = cold + (1.0 - cold) * std::erfc(0.5 * x);
      double const slope = -(1.0 - cold) * std::numbers::inv_sqrtpi * std::exp(-0.25 * x * x);
      BOOST_TEST(std::abs(exact.temperature(x, 1.0) - expected) <= exact.accuracy());
      BOOST_TEST(std::abs(exact.gradient(x, 1.0) - slope) <= exact.accuracy());
    }
    BOOST_TEST(exact.heat(1.0) == 2.0 * std::numbers::inv_sqrtpi * (1.0 - cold),
               boost::test_tools::tolerance(1e-12));
  }
}

// The heat that a cold medium already holds, and its conductivity, change the wave in proportion.
BOOST_AUTO_TEST_CASE(a_cold_medium_has_the_marshak_wave) {
  for (double const n : {0.5, 1.0, 3.0, 6.5}) {
    Marshak const wave(n);
    for (double const cold : {1e-4, 1e-8}) {
      ColdFront const exact(n, cold, 1.0);
      for (double x = 0.01; x < 2.0; x += 0.0137) {
        if (std::abs(x - wave.front(1.0)) < 0.02) continue;
        double const expected = std::max(cold, wave.temperature(x, 1.0));
        BOOST_TEST(std::abs(exact.temperature(x, 1.0) - expected) < 4.0 * cold, "n = " << n << ", x = " << x);
      }
      BOOST_TEST(std::abs(exact.heat(1.0) - wave.total_energy(1.0)) < 4.0 * cold);
    }
  }
}

// Space step 0.003: the flux's derivative is good to 1e-9 where the wave is smooth.
BOOST_AUTO_TEST_CASE(temperature_solves_its_equation) {
  for (double const n : {1.0, 3.0, 6.5}) {
    for (double const cold : {0.5, 0.1, 0.01}) {
      ColdFront const exact(n, cold, 1.3);
      auto const flux = [&](double x, double t) {
        return exact.conductivity(exact.temperature(x, t)) * exact.gradient(x, t);
      };
      double const t = 0.2;
      std::size_t checked = 0;
      for (double x = 0.02; x < 1.0; x += 0.013) {
        double const curve = std::abs(flux(x + 0.01, t) - 2.0 * flux(x, t) + flux(x - 0.01, t));
        if (curve > 3e-3) continue;  // the foot of the wave
        double const rate = first_derivative([&](double s) { return exact.temperature(x, s); }, t, 1e-3);
        double const divergence = first_derivative([&](double s) { return flux(s, t); }, x, 2e-3);
        BOOST_TEST(std::abs(rate - divergence) < 2e-6 * (1.0 + std::abs(rate)),
                   "n = " << n << ", cold = " << cold << ", x = " << x);
        ++checked;
      }
      BOOST_TEST(checked > 20u);
    }
  }
}

BOOST_AUTO_TEST_CASE(gradient_is_the_derivative_of_the_temperature) {
  ColdFront const exact(3.0, 0.2, 1.3);
  for (double const x : {0.1, 0.2, 0.3, 0.6}) {
    double const slope = first_derivative([&](double s) { return exact.temperature(s, 0.2); }, x, 1e-3);
    BOOST_TEST(std::abs(exact.gradient(x, 0.2) - slope) < 1e-7);
  }
}

// The similarity equation in xi by classical Runge-Kutta from the wall, where it starts with our slope: that
// this is the right one shows in the march below.
BOOST_AUTO_TEST_CASE(temperature_is_as_accurate_as_promised) {
  for (double const n : {0.5, 1.0, 3.0, 6.5}) {
    for (double const cold : {0.5, 0.1, 1e-3, 1e-6}) {
      ColdFront const exact(n, cold, 1.0);
      double const end = 0.9 * exact.front(1.0);
      constexpr int steps = 4000;
      double const h = end / steps;
      double f = 1.0;
      double q = -exact.gradient(0.0, 1.0);  // -f^n f'
      auto const slopes = [n](double xi, double T, double flux) {
        double const slope = -flux / std::pow(T, n);
        return std::pair{slope, 0.5 * xi * slope};
      };
      double worst = 0.0;
      for (int k = 0; k < steps; ++k) {
        double const xi = k * h;
        auto const [f1, q1] = slopes(xi, f, q);
        auto const [f2, q2] = slopes(xi + 0.5 * h, f + 0.5 * h * f1, q + 0.5 * h * q1);
        auto const [f3, q3] = slopes(xi + 0.5 * h, f + 0.5 * h * f2, q + 0.5 * h * q2);
        auto const [f4, q4] = slopes(xi + h, f + h * f3, q + h * q3);
        f += h / 6.0 * (f1 + 2.0 * f2 + 2.0 * f3 + f4);
        q += h / 6.0 * (q1 + 2.0 * q2 + 2.0 * q3 + q4);
        worst = std::max(worst, std::abs(f - exact.temperature(xi + h, 1.0)));
      }
      BOOST_TEST(worst <= exact.accuracy(), "n = " << n << ", cold = " << cold << ": " << worst);
    }
  }
}

/// The heat equation itself by finite volumes on [0, 1], far beyond the wave, marched by an explicit rule of
/// second order: it knows of no similarity.
std::vector<double> marched(double n, double cold, std::size_t cells, double end) {
  double const width = 1.0 / static_cast<double>(cells);
  auto const potential = [n](double T) { return std::pow(T, n + 1.0) / (n + 1.0); };  // K dT = d(this)
  auto const rates = [&](std::vector<double> const& T) {
    std::vector<double> rate(cells);
    for (std::size_t c = 0; c < cells; ++c) {
      double const here = potential(T[c]);
      double const inflow = c > 0 ? potential(T[c - 1]) - here : 2.0 * (potential(1.0) - here);
      double const outflow = c + 1 < cells ? here - potential(T[c + 1]) : 2.0 * (here - potential(cold));
      rate[c] = (inflow - outflow) / (width * width);
    }
    return rate;
  };
  std::vector<double> T(cells, cold);
  auto const steps = static_cast<int>(std::ceil(end / (0.2 * width * width)));
  double const dt = end / steps;
  for (int k = 0; k < steps; ++k) {
    std::vector<double> const first = rates(T);
    std::vector<double> middle(T);
    for (std::size_t c = 0; c < cells; ++c) middle[c] += 0.5 * dt * first[c];
    std::vector<double> const second = rates(middle);
    for (std::size_t c = 0; c < cells; ++c) T[c] += dt * second[c];
  }
  return T;
}

BOOST_AUTO_TEST_CASE(temperature_agrees_with_the_equation_marched_in_time) {
  for (double const n : {3.0, 6.5}) {
    for (double const cold : {0.5, 0.01, 1e-6}) {
      ColdFront const exact(n, cold, 1.0);
      double const end = 0.1;
      double error[2];
      for (int level = 0; level < 2; ++level) {
        std::size_t const cells = level == 0 ? 100 : 200;
        std::vector<double> const T = marched(n, cold, cells, end);
        error[level] = 0.0;
        for (std::size_t c = 0; c < cells; ++c) {
          double const x = (static_cast<double>(c) + 0.5) / static_cast<double>(cells);
          error[level] += std::abs(T[c] - exact.temperature(x, end)) / static_cast<double>(cells);
        }
      }
      BOOST_TEST_MESSAGE("n = " << n << ", cold = " << cold << ": " << error[0] << " " << error[1]);
      // A steep front is off by part of a cell, whatever their number; a smooth one converges.
      BOOST_TEST(error[1] < (cold == 0.5 ? 2e-5 : 7e-4));
      if (cold == 0.5) BOOST_TEST(error[1] < 0.3 * error[0]);
    }
  }
}

BOOST_AUTO_TEST_CASE(heat_in_the_medium_is_what_came_through_the_wall) {
  for (double const n : {0.0, 3.0, 6.5}) {
    for (double const cold : {0.3, 1e-3}) {
      ColdFront const exact(n, cold, 1.3);
      double const t = 0.3;
      double const front = exact.front(t);
      auto const excess = [&](double x) { return exact.temperature(x, t) - cold; };
      double sum = 0.0;
      double from = 0.0;
      for (double const to : {0.5, 0.9, 0.95, 0.98, 1.0, 1.01, 1.02, 1.05, 1.1, 1.3, 2.0, 5.0, 20.0}) {
        sum += integral(excess, from, to * front);
        from = to * front;
      }
      BOOST_TEST(exact.heat(t) == sum, boost::test_tools::tolerance(1e-8));
    }
  }
}

BOOST_AUTO_TEST_CASE(temperature_falls_from_the_wall_to_the_medium) {
  for (double const n : {0.0, 1.0, 3.0, 6.5}) {
    for (double const cold : {0.9, 0.1, 1e-6, 1e-9}) {
      ColdFront const exact(n, cold, 1.0);
      BOOST_TEST(exact.temperature(0.0, 0.5) == 1.0);
      BOOST_TEST(std::abs(exact.temperature(1e-12, 0.5) - 1.0) < 1e-11);
      double before = 1.0;
      for (double x = 0.001; x < 3.0; x += 0.001) {
        double const T = exact.temperature(x, 0.5);
        BOOST_REQUIRE((T <= before && T >= cold));
        BOOST_REQUIRE(std::isfinite(exact.gradient(x, 0.5)));
        BOOST_REQUIRE(exact.gradient(x, 0.5) <= 0.0);
        before = T;
      }
      BOOST_TEST(exact.temperature(1e3, 0.5) == cold);
      BOOST_TEST(exact.temperature(exact.front(0.5), 0.5) == 0.5 * (1.0 + cold),
                 boost::test_tools::tolerance(1e-10));
    }
  }
}

// Places depend on K0 t alone.
BOOST_AUTO_TEST_CASE(all_lengths_and_the_heat_grow_as_the_root_of_conductivity_times_time) {
  ColdFront const one(3.0, 0.01, 1.0);
  ColdFront const two(3.0, 0.01, 2.0);
  for (double const t : {0.3, 0.7}) {
    double const scale = std::sqrt(2.0 * t);
    BOOST_TEST(two.front(t) == scale * one.front(1.0), boost::test_tools::tolerance(1e-12));
    BOOST_TEST(two.foot(t) == scale * one.foot(1.0), boost::test_tools::tolerance(1e-12));
    BOOST_TEST(two.foot_width(t) == scale * one.foot_width(1.0), boost::test_tools::tolerance(1e-12));
    BOOST_TEST(two.heat(t) == scale * one.heat(1.0), boost::test_tools::tolerance(1e-12));
    BOOST_TEST(two.temperature(0.4 * scale, t) == one.temperature(0.4, 1.0), boost::test_tools::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(initial_state_is_uniform_but_for_the_wall) {
  ColdFront const exact(3.0, 0.01, 1.0);
  BOOST_TEST(exact.temperature(0.0, 0.0) == 1.0);
  BOOST_TEST(exact.temperature(1e-300, 0.0) == 0.01);
  BOOST_TEST(exact.gradient(0.0, 0.0) == -std::numeric_limits<double>::infinity());
  BOOST_TEST(exact.gradient(0.1, 0.0) == 0.0);
  BOOST_TEST(exact.heat(0.0) == 0.0);
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(refuses([] { ColdFront(3.0, 0.0, 1.0); }, "cold temperature must be positive, found 0"));
  BOOST_TEST(
      refuses([] { ColdFront(3.0, 1.0, 1.0); }, "cold temperature must be below the wall's 1, found 1"));
  BOOST_TEST(refuses([] { ColdFront(-1.0, 0.1, 1.0); }, "exponent must be zero or positive, found -1"));
  BOOST_TEST(refuses([] { ColdFront(50.0, 1e-6, 1.0); },
                     "exponent must be at most 33.3333, for cold^exponent above 1e-200, found 50"));
  BOOST_TEST(refuses([] { ColdFront(3.0, 0.1, 0.0); }, "conductivity must be positive, found 0"));
  BOOST_TEST(refuses([] { ColdFront(3.0, 0.1, 1.0).temperature(0.5, -1.0); },
                     "time must be zero or positive, found -1"));
}

BOOST_AUTO_TEST_SUITE_END()
