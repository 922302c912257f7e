// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/radiating_half_space.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_radiating_half_space)

using namespace sphverify::exact;
using namespace sphverify::tests;

constexpr double radiation = 3.0;
constexpr double conductivity = 1.7;
constexpr double density = 0.6;
constexpr double diffusivity = conductivity / density;

RadiatingHalfSpace half_space(int exponent, double start, double environment) {
  return RadiatingHalfSpace(radiation, exponent, start, environment, conductivity, density);
}

/// Cooling into nothing, cooling and warming, and warming from nothing.
constexpr std::array<std::array<double, 2>, 4> temperatures{{{1.2, 0.0}, {1.2, 0.6}, {0.3, 1.1}, {0.0, 1.1}}};

/// exp(a^2) erfc(a).
double scaled_erfc(double a) {
  if (a < 25.0) return std::exp(a * a) * std::erfc(a);
  double const q = 0.5 / (a * a);  // the asymptotic series, to (2 a^2)^-8
  double sum = 0.0;
  for (int k = 15; k >= 1; k -= 2) sum = 1.0 - k * q * sum;
  return std::numbers::inv_sqrtpi / a * sum;
}

// Carslaw & Jaeger 1959, section 2.7, eq. (1) for Newton's law of cooling.
BOOST_AUTO_TEST_CASE(linear_loss_is_the_closed_form_of_newtons_law_of_cooling) {
  for (auto const& [start, environment] : temperatures) {
    RadiatingHalfSpace const exact = half_space(1, start, environment);
    double const h = radiation / conductivity;
    for (double t = 1e-7; t < 10.0; t *= 3.7) {
      double const spread = std::sqrt(diffusivity * t);
      for (double const x : {0.0, 1e-12, 1e-6, 1e-3, 0.02, 0.1, 0.4, 1.5, 7.0}) {
        double const q = 0.5 * x / spread;
        double const part = std::erf(q) + std::exp(-q * q) * scaled_erfc(q + h * spread);
        double const expected = environment + (start - environment) * part;
        BOOST_TEST(std::abs(exact.temperature(x, t) - expected) < 1e-11, "x = " << x << ", t = " << t);
        double const slope = (start - environment) * h * std::exp(-q * q) * scaled_erfc(q + h * spread);
        BOOST_TEST(std::abs(exact.gradient(x, t) - slope) < 1e-10, "x = " << x << ", t = " << t);
      }
    }
  }
}

/// Integral of loss(T_w(s)) / sqrt(t - s), from s = 0 by quadrature that knows nothing of the solution's
/// mesh.
double taken(RadiatingHalfSpace const& exact, double t) {
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;  // adaptive
  double const z = std::sqrt(t);
  double sum = 0.0;
  double before = 0.0;
  for (int k = 30; k >= 1; --k) {
    double const end = std::ldexp(z, -k);
    auto const integrand = [&](double y) {
      return exact.lost(exact.wall_temperature(y * y)) * 2.0 * y / std::sqrt((z - y) * (z + y));
    };
    sum += Rule::integrate(integrand, before, end, 4, 1e-12);
    before = end;
  }
  auto const rest = [&](double psi) {
    double const y = z * std::cos(psi);
    return exact.lost(exact.wall_temperature(y * y)) * 2.0 * y;
  };
  return sum + Rule::integrate(rest, 0.0, std::acos(0.5), 4, 1e-12);
}

BOOST_AUTO_TEST_CASE(wall_temperature_solves_its_volterra_equation_early_and_late) {
  for (int const exponent : {1, 4, 8}) {
    for (auto const& [start, environment] : temperatures) {
      RadiatingHalfSpace const exact = half_space(exponent, start, environment);
      for (double t = 1e-7; t < 1e6; t *= 190.0) {
        double const expected =
            start - taken(exact, t) / std::sqrt(std::numbers::pi * conductivity * density);
        BOOST_TEST(std::abs(exact.wall_temperature(t) - expected) < 1e-11,
                   "n = " << exponent << ", from " << start << " to " << environment << ", t = " << t);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(temperature_solves_the_heat_equation_and_the_gradient_is_its_slope) {
  for (auto const& [start, environment] : temperatures) {
    RadiatingHalfSpace const exact = half_space(4, start, environment);
    for (double const t : {1e-4, 0.01, 1.0, 100.0}) {
      double const layer = std::sqrt(diffusivity * t);
      for (double x = 0.1 * layer; x < 8.0 * layer; x += 0.3 * layer) {
        double const rate = first_derivative([&](double s) { return exact.temperature(x, s); }, t, 0.02 * t);
        auto const in_space = [&](double s) { return exact.temperature(s, t); };
        double const curvature = second_derivative(in_space, x, 0.02 * layer);
        BOOST_TEST(std::abs(density * rate - conductivity * curvature) < 1e-7 / t,
                   "x = " << x << ", t = " << t);
        double const slope = first_derivative(in_space, x, 0.02 * layer);
        BOOST_TEST(std::abs(exact.gradient(x, t) - slope) < 1e-8 / layer, "x = " << x << ", t = " << t);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(what_reaches_the_wall_by_fouriers_law_is_what_it_loses) {
  for (auto const& [start, environment] : temperatures) {
    RadiatingHalfSpace const exact = half_space(4, start, environment);
    for (double const t : {1e-4, 0.03, 2.0}) {
      double const loss = radiation * (std::pow(exact.wall_temperature(t), 4) - std::pow(environment, 4));
      BOOST_TEST(exact.lost(exact.wall_temperature(t)) == loss, boost::test_tools::tolerance(1e-13));
      BOOST_TEST(std::abs(conductivity * exact.gradient(0.0, t) - loss) < 1e-12);
      // From within, by one-sided differences of second order and their limit.
      auto const inner = [&](double h) {
        return (-3.0 * exact.temperature(0.0, t) + 4.0 * exact.temperature(h, t) -
                exact.temperature(2.0 * h, t)) /
               (2.0 * h);
      };
      double const h = 2e-3 * std::sqrt(diffusivity * t);
      double const slope = (4.0 * inner(h) - inner(2.0 * h)) / 3.0;
      BOOST_TEST(std::abs(conductivity * slope - loss) < 1e-5 * (1.0 + std::abs(loss)));
      BOOST_TEST(std::abs(exact.gradient(1e-9, t) - exact.gradient(0.0, t)) < 1e-6);
    }
  }
}

BOOST_AUTO_TEST_CASE(heat_that_the_wall_has_lost_is_missing_from_the_half_space) {
  RadiatingHalfSpace const exact = half_space(4, 1.2, 0.2);
  for (double const t : {0.01, 1.0}) {
    double const reach = 13.0 * std::sqrt(diffusivity * t);
    double const missing =
        density * integral([&](double x) { return 1.2 - exact.temperature(x, t); }, 0.0, reach);
    double const lost = integral(
        [&](double y) { return 2.0 * y * exact.lost(exact.wall_temperature(y * y)); }, 0.0, std::sqrt(t));
    BOOST_TEST(missing == lost, boost::test_tools::tolerance(1e-10));
  }
}

// T_w = start - 2 loss(start) z + loss'(start) loss(start) pi z^2 - ..., z = sqrt(t/(pi K rho)): each term is
// the half integral of what the one before it loses.
BOOST_AUTO_TEST_CASE(early_wall_temperature_is_its_series_in_the_root_of_time) {
  RadiatingHalfSpace const exact = half_space(4, 1.2, 0.6);
  double const slope = 4.0 * radiation * std::pow(1.2, 3);
  for (double const t : {1e-10, 1e-8, 1e-6}) {
    double const z = std::sqrt(t / (std::numbers::pi * conductivity * density));
    double const loss = exact.lost(1.2);
    double const expected = 1.2 - 2.0 * loss * z + slope * loss * std::numbers::pi * z * z;
    BOOST_TEST(std::abs(exact.wall_temperature(t) - expected) < 3.0 * std::pow(slope * z, 3) + 1e-13);
  }
}

/// The wall's temperature by product integration with a loss that is linear between nodes at equal steps of
/// sqrt(t), so that the mesh is graded: of second order, and of a code of its own.
double by_linear_product_integration(RadiatingHalfSpace const& law, double start, double t, int steps) {
  double const dz = std::sqrt(t) / steps;
  double const scale = 1.0 / std::sqrt(std::numbers::pi * conductivity * density);
  std::vector<double> loss{law.lost(start)};
  double wall = start;
  for (int n = 1; n <= steps; ++n) {
    double const z = n * dz;
    // Integrals over [a, b] of 2 y/sqrt(z^2 - y^2) and of 2 y^2/sqrt(z^2 - y^2).
    auto const zeroth = [z](double y) { return -2.0 * std::sqrt(std::max(0.0, z * z - y * y)); };
    auto const first = [z](double y) {
      return z * z * std::asin(std::min(1.0, y / z)) - y * std::sqrt(std::max(0.0, z * z - y * y));
    };
    double known = start;
    double own = 0.0;
    for (int k = 0; k < n; ++k) {
      double const a = k * dz;
      double const whole = zeroth(a + dz) - zeroth(a);
      double const upper = (first(a + dz) - first(a) - a * whole) / dz;
      known -= scale * (whole - upper) * loss[k];
      if (k + 1 < n) {
        known -= scale * upper * loss[k + 1];
      } else {
        own = scale * upper;
      }
    }
    double low = -1.0, high = 2.0;  // bisection
    for (int i = 0; i < 60; ++i) {
      wall = 0.5 * (low + high);
      (wall + own * law.lost(wall) > known ? high : low) = wall;
    }
    loss.push_back(law.lost(wall));
  }
  return wall;
}

BOOST_AUTO_TEST_CASE(a_method_of_second_order_converges_to_it_at_second_order) {
  for (auto const& [start, environment] : temperatures) {
    RadiatingHalfSpace const exact = half_space(4, start, environment);
    auto const error = [&, s = start](int steps) {
      return std::abs(by_linear_product_integration(exact, s, 0.5, steps) - exact.wall_temperature(0.5));
    };
    double const coarse = error(100);
    double const fine = error(200);
    BOOST_TEST(std::log2(coarse / fine) == 2.0, boost::test_tools::tolerance(0.05));
    BOOST_TEST(fine < 1e-4);
  }
}

// Where all that reaches the wall is lost at once: T_w^4 = K start/(radiation sqrt(pi kappa t)) to first
// order.
BOOST_AUTO_TEST_CASE(late_walls_lose_what_a_wall_at_zero_would_take) {
  RadiatingHalfSpace const exact = half_space(4, 1.2, 0.0);
  double const t = 1e8;
  double const flux = conductivity * 1.2 / std::sqrt(std::numbers::pi * diffusivity * t);
  BOOST_TEST(exact.lost(exact.wall_temperature(t)) == flux, boost::test_tools::tolerance(0.1));
}

BOOST_AUTO_TEST_CASE(at_the_start_and_in_the_depth_nothing_has_happened) {
  RadiatingHalfSpace const exact = half_space(4, 1.2, 0.0);
  for (double const x : {0.0, 1e-3, 1.0}) BOOST_TEST(exact.temperature(x, 0.0) == 1.2);
  BOOST_TEST(exact.gradient(0.1, 0.0) == 0.0);
  BOOST_TEST(exact.gradient(0.0, 0.0) == radiation * std::pow(1.2, 4) / conductivity,
             boost::test_tools::tolerance(1e-14));
  BOOST_TEST(exact.temperature(1e3, 1.0) == 1.2);
  BOOST_TEST(exact.gradient(1e3, 1.0) == 0.0);
  RadiatingHalfSpace const steady = half_space(4, 0.7, 0.7);
  for (double const t : {0.0, 1.0, 1e4}) BOOST_TEST(steady.temperature(0.0, t) == 0.7);
}

BOOST_AUTO_TEST_CASE(loss_rises_with_temperature_below_zero_too) {
  RadiatingHalfSpace const exact = half_space(4, 1.2, 0.5);
  for (double T = -2.0; T < 2.0; T += 0.1) BOOST_TEST(exact.lost(T + 0.1) > exact.lost(T));
  BOOST_TEST(exact.lost(0.5) == 0.0);
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(refuses([] { RadiatingHalfSpace(0, 4, 1, 0, 1, 1); }, "radiation must be positive, found 0"));
  BOOST_TEST(refuses([] { RadiatingHalfSpace(1, 0, 1, 0, 1, 1); }, "exponent must be from 1 to 8, found 0"));
  BOOST_TEST(refuses([] { RadiatingHalfSpace(1, 9, 1, 0, 1, 1); }, "exponent must be from 1 to 8, found 9"));
  BOOST_TEST(
      refuses([] { RadiatingHalfSpace(1, 4, -1, 0, 1, 1); }, "start must be zero or positive, found -1"));
  BOOST_TEST(refuses([] { RadiatingHalfSpace(1, 4, 1, -1, 1, 1); },
                     "environment must be zero or positive, found -1"));
  BOOST_TEST(refuses([] { RadiatingHalfSpace(1, 4, 0, 0, 1, 1); },
                     "start must be positive where the environment is at 0, found 0"));
  BOOST_TEST(refuses([] { RadiatingHalfSpace(1, 4, 1, 0, 0, 1); }, "conductivity must be positive, found 0"));
  BOOST_TEST(refuses([] { RadiatingHalfSpace(1, 4, 1, 0, 1, 0); }, "density must be positive, found 0"));
  RadiatingHalfSpace const exact(1, 4, 1, 0, 1, 1);
  BOOST_TEST(refuses([&] { exact.temperature(0.5, -1.0); }, "time must be zero or positive, found -1"));
  BOOST_TEST(refuses([&] { exact.wall_temperature(2e10); }, "time must be at most 1e+10, found 2e+10"));
}

BOOST_AUTO_TEST_SUITE_END()
