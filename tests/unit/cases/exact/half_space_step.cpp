// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/half_space_step.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_half_space_step)

using namespace sphverify::exact;
using namespace sphverify::tests;

constexpr double wall = 3.0;
constexpr double initial = 0.4;
constexpr double conductivity = 1.7;
constexpr double density = 0.6;
constexpr double diffusivity = conductivity / density;
constexpr double infinity = std::numeric_limits<double>::infinity();

HalfSpaceStep step() { return HalfSpaceStep(wall, initial, conductivity, density); }

// Steps of a fiftieth of the layer's thickness and of the age: truncation and rounding below 1e-7 of the
// rates.
BOOST_AUTO_TEST_CASE(temperature_solves_the_heat_equation) {
  HalfSpaceStep const exact = step();
  for (double const t : {1e-4, 0.01, 1.0}) {
    double const layer = std::sqrt(diffusivity * t);
    for (double x = 0.1 * layer; x < 8.0 * layer; x += 0.3 * layer) {
      double const rate = first_derivative([&](double s) { return exact.temperature(x, s); }, t, 0.02 * t);
      double const curvature =
          second_derivative([&](double s) { return exact.temperature(s, t); }, x, 0.02 * layer);
      BOOST_TEST(std::abs(density * rate - conductivity * curvature) < 1e-7 / t,
                 "x = " << x << ", t = " << t);
    }
  }
}

BOOST_AUTO_TEST_CASE(wall_keeps_its_temperature_and_depth_its_initial_one) {
  HalfSpaceStep const exact = step();
  for (double const t : {1e-6, 0.01, 1.0}) {
    BOOST_TEST(exact.temperature(0.0, t) == wall);
    BOOST_TEST(exact.temperature(30.0 * std::sqrt(diffusivity * t), t) == initial);
  }
}

BOOST_AUTO_TEST_CASE(initial_state_is_a_step_at_the_wall) {
  HalfSpaceStep const exact = step();
  BOOST_TEST(exact.temperature(0.0, 0.0) == wall);
  BOOST_TEST(exact.temperature(1e-300, 0.0) == initial);
  BOOST_TEST(exact.gradient(0.0, 0.0) == -infinity);
  BOOST_TEST(exact.gradient(0.1, 0.0) == 0.0);
  BOOST_TEST(HalfSpaceStep(0.0, 1.0, 1.0, 1.0).gradient(0.0, 0.0) == infinity);
  BOOST_TEST(HalfSpaceStep(1.0, 1.0, 1.0, 1.0).gradient(0.0, 0.0) == 0.0);
}

BOOST_AUTO_TEST_CASE(gradient_is_the_derivative_of_the_temperature) {
  HalfSpaceStep const exact = step();
  for (double const t : {0.01, 0.2}) {
    double const layer = std::sqrt(diffusivity * t);
    for (double const x : {0.0, 0.2 * layer, layer, 4.0 * layer}) {
      double const expected =
          first_derivative([&](double s) { return exact.temperature(s, t); }, x, 0.02 * layer);
      BOOST_TEST(std::abs(exact.gradient(x, t) - expected) * layer < 1e-10);
    }
  }
}

BOOST_AUTO_TEST_CASE(energy_of_the_medium_is_what_the_wall_gave) {
  HalfSpaceStep const exact = step();
  double const t = 0.3;
  double const depth = 24.0 * std::sqrt(diffusivity * t);
  double const energy =
      density * integral([&](double x) { return exact.temperature(x, t) - initial; }, 0.0, depth);
  // s = sqrt(time) takes the flux's singularity at the start out of the integrand.
  double const given = integral(
      [&](double s) { return -conductivity * exact.gradient(0.0, s * s) * 2.0 * s; }, 0.0, std::sqrt(t));
  BOOST_TEST(std::abs(energy - given) < 1e-11);
  BOOST_TEST(std::abs(energy - 2.0 * density * (wall - initial) *
                                   std::sqrt(diffusivity * t / std::numbers::pi)) < 1e-11);
}

BOOST_AUTO_TEST_CASE(temperature_lies_between_wall_and_initial_and_falls_inwards) {
  HalfSpaceStep const exact = step();
  double previous = wall;
  for (double x = 0.01; x < 3.0; x += 0.01) {
    double const value = exact.temperature(x, 0.05);
    BOOST_TEST(value < previous);
    BOOST_TEST(value > initial);
    previous = value;
  }
}

BOOST_AUTO_TEST_CASE(temperature_is_as_accurate_as_promised) {
  HalfSpaceStep const exact = step();
  BOOST_TEST(exact.accuracy() < 1e-14);
  for (double const t : {1e-4, 0.013, 0.7}) {
    for (double x = 0.0; x < 6.0; x += 0.017) {
      long double const z = x / (2.0L * std::sqrt(static_cast<long double>(conductivity) / density * t));
      long double const expected = initial + (static_cast<long double>(wall) - initial) * std::erfc(z);
      BOOST_TEST(std::abs(static_cast<double>(exact.temperature(x, t) - expected)) <= exact.accuracy());
    }
  }
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(refuses([] { HalfSpaceStep(1, 0, -1, 1); }, "conductivity must be positive, found -1"));
  BOOST_TEST(refuses([] { HalfSpaceStep(1, 0, 1, 0); }, "density must be positive, found 0"));
  BOOST_CHECK_THROW(HalfSpaceStep(infinity, 0, 1, 1), std::invalid_argument);
  BOOST_CHECK_THROW(HalfSpaceStep(1, infinity, 1, 1), std::invalid_argument);
  BOOST_TEST(refuses([] { step().temperature(0.5, -1.0); }, "time must be zero or positive, found -1"));
  BOOST_CHECK_THROW(step().gradient(0.5, -1.0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
