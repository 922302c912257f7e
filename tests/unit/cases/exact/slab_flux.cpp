// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/slab_flux.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_slab_flux)

using namespace sphverify::exact;
using namespace sphverify::tests;

constexpr double initial = 0.4;
constexpr double flux = 1.3;
constexpr double conductivity = 1.7;
constexpr double density = 0.6;
constexpr double diffusivity = conductivity / density;

SlabFlux slab() { return SlabFlux(initial, flux, conductivity, density); }

// Times on both sides of the change of series, kappa t = 0.1. At the first one the layer is 0.1 thick, so
// that with a step of 0.004 the truncation error is below 1e-6; the rates there are of order 10.
BOOST_AUTO_TEST_CASE(temperature_solves_the_heat_equation_by_either_series) {
  SlabFlux const exact = slab();
  for (double const t : {0.003, 0.01, 0.03, 0.04, 0.2}) {
    for (double x = 0.05; x < 1.0; x += 0.06) {
      double const rate = first_derivative([&](double s) { return exact.temperature(x, s); }, t, 2e-5);
      double const curvature = second_derivative([&](double s) { return exact.temperature(s, t); }, x, 0.004);
      BOOST_TEST(std::abs(density * rate - conductivity * curvature) < 1e-6, "x = " << x << ", t = " << t);
    }
  }
}

BOOST_AUTO_TEST_CASE(prescribed_flux_enters_at_the_left_and_none_leaves_at_the_right) {
  SlabFlux const exact = slab();
  for (double const t : {1e-6, 0.01, 0.03, 0.04, 0.2, 3.0}) {
    BOOST_TEST(std::abs(-conductivity * exact.gradient(0.0, t) - flux) < 1e-14);
    BOOST_TEST(std::abs(exact.gradient(1.0, t)) < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(energy_grows_by_the_flux) {
  SlabFlux const exact = slab();
  for (double const t : {0.001, 0.03, 0.04, 0.5}) {
    double const energy = density * integral([&](double x) { return exact.temperature(x, t); }, 0.0, 1.0);
    BOOST_TEST(std::abs(energy - density * initial - flux * t) < 1e-12, "t = " << t);
  }
}

BOOST_AUTO_TEST_CASE(the_two_series_agree_wherever_both_converge) {
  SlabFlux const exact = slab();
  double worst = 0.0;
  double worst_slope = 0.0;
  for (double const kappa_t : {0.01, 0.03, 0.0999, 0.1001, 0.3, 1.0, 10.0}) {
    double const t = kappa_t / diffusivity;
    double const scale = std::max(1.0, flux * t / density);
    for (double x = 0.0; x <= 1.0; x += 0.01) {
      worst = std::max(
          worst, std::abs(exact.temperature_by_modes(x, t) - exact.temperature_by_images(x, t)) / scale);
      worst_slope =
          std::max(worst_slope, std::abs(exact.gradient_by_modes(x, t) - exact.gradient_by_images(x, t)));
    }
  }
  BOOST_TEST_MESSAGE("largest difference of temperature " << worst << ", of gradient " << worst_slope);
  BOOST_TEST(worst <= exact.accuracy());
  BOOST_TEST(worst_slope < 1e-14);
  BOOST_TEST(exact.accuracy() < 1e-14);
}

BOOST_AUTO_TEST_CASE(each_time_takes_the_series_that_converges_there) {
  SlabFlux const exact = slab();
  for (double const x : {0.0, 0.3, 1.0}) {
    BOOST_TEST(exact.temperature(x, 0.09 / diffusivity) ==
               exact.temperature_by_images(x, 0.09 / diffusivity));
    BOOST_TEST(exact.temperature(x, 0.11 / diffusivity) == exact.temperature_by_modes(x, 0.11 / diffusivity));
    BOOST_TEST(exact.gradient(x, 0.09 / diffusivity) == exact.gradient_by_images(x, 0.09 / diffusivity));
    BOOST_TEST(exact.gradient(x, 0.11 / diffusivity) == exact.gradient_by_modes(x, 0.11 / diffusivity));
  }
}

BOOST_AUTO_TEST_CASE(early_wall_temperature_is_that_of_a_half_space) {
  SlabFlux const exact = slab();
  for (double const t : {1e-8, 1e-4, 1e-3}) {
    double const expected =
        initial + 2.0 * flux / conductivity * std::sqrt(diffusivity * t / std::numbers::pi);
    BOOST_TEST(std::abs(exact.temperature(0.0, t) - expected) <= exact.accuracy());
  }
}

BOOST_AUTO_TEST_CASE(late_state_is_a_parabola_that_rises_uniformly) {
  SlabFlux const exact = slab();
  double const t = 3.0;
  double const steady = exact.temperature(0.0, t) - exact.temperature(1.0, t);
  BOOST_TEST(std::abs(steady - 0.5 * flux / conductivity) < 1e-14);
  BOOST_TEST(std::abs(exact.temperature(0.3, t + 1.0) - exact.temperature(0.3, t) - flux / density) < 1e-14);
}

BOOST_AUTO_TEST_CASE(initial_state_is_uniform) {
  SlabFlux const exact = slab();
  for (double const x : {0.0, 0.2, 1.0}) BOOST_TEST(exact.temperature(x, 0.0) == initial);
  BOOST_TEST(exact.gradient(0.0, 0.0) == -flux / conductivity);
  BOOST_TEST(exact.gradient(0.2, 0.0) == 0.0);
  BOOST_TEST(exact.gradient(1.0, 0.0) == 0.0);
  BOOST_TEST(std::abs(exact.temperature(0.2, 1e-5) - initial) <= exact.accuracy());
}

BOOST_AUTO_TEST_CASE(gradient_is_the_derivative_of_the_temperature) {
  SlabFlux const exact = slab();
  for (double const t : {0.01, 0.2}) {
    for (double const x : {0.0, 0.13, 0.5, 0.77, 1.0}) {
      double const expected = first_derivative([&](double s) { return exact.temperature(s, t); }, x, 0.004);
      BOOST_TEST(std::abs(exact.gradient(x, t) - expected) < 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_flux_out_of_the_slab_cools_it) {
  SlabFlux const cooled(initial, -flux, conductivity, density);
  for (double const t : {0.01, 0.5}) {
    BOOST_TEST(std::abs(cooled.temperature(0.2, t) + slab().temperature(0.2, t) - 2.0 * initial) < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(refuses([] { SlabFlux(0, 1, -1, 1); }, "conductivity must be positive, found -1"));
  BOOST_TEST(refuses([] { SlabFlux(0, 1, 1, 0); }, "density must be positive, found 0"));
  double const nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_THROW(SlabFlux(nan, 1, 1, 1), std::invalid_argument);
  BOOST_CHECK_THROW(SlabFlux(0, nan, 1, 1), std::invalid_argument);
  BOOST_CHECK_THROW(slab().temperature(0.5, -1.0), std::invalid_argument);
  BOOST_CHECK_THROW(slab().gradient(0.5, -1.0), std::invalid_argument);
  BOOST_CHECK_THROW(slab().temperature(0.5, nan), std::invalid_argument);
  BOOST_CHECK_THROW(slab().temperature_by_modes(0.5, 0.0), std::invalid_argument);
  BOOST_CHECK_THROW(slab().gradient_by_modes(0.5, 0.0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
