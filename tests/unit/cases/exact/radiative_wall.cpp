// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/radiative_wall.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_radiative_wall)

using namespace sphverify::exact;
using namespace sphverify::tests;

constexpr double radiation = 0.3;
constexpr double environment = 0.8;
constexpr double conductivity = 1.7;
constexpr double density = 0.6;

RadiativeWall slab() { return RadiativeWall(radiation, 2.0, environment, 0.04, conductivity, density); }

BOOST_AUTO_TEST_CASE(temperature_solves_the_heat_equation_with_its_source) {
  RadiativeWall const exact = slab();
  for (double const t : {0.002, 0.02, 0.2}) {
    for (double x = 0.05; x < 1.0; x += 0.06) {
      double const rate = first_derivative([&](double s) { return exact.temperature(x, s); }, t, 5e-4);
      double const curvature = second_derivative([&](double s) { return exact.temperature(s, t); }, x, 0.01);
      double const source = density * exact.source(x, t);
      BOOST_TEST(std::abs(density * rate - conductivity * curvature - source) < 1e-8,
                 "x = " << x << ", t = " << t);
    }
  }
}

BOOST_AUTO_TEST_CASE(one_wall_radiates_as_the_fourth_power_and_the_other_is_insulated) {
  RadiativeWall const exact = slab();
  for (double const t : {0.0, 0.01, 0.05, 1.0}) {
    auto const slope = [&](double x) {
      return first_derivative([&](double s) { return exact.temperature(s, t); }, x, 0.01);
    };
    double const T = exact.temperature(1.0, t);
    double const lost = radiation * (std::pow(T, 4) - std::pow(environment, 4));
    BOOST_TEST(std::abs(-conductivity * slope(1.0) - lost) < 1e-10);
    BOOST_TEST(std::abs(slope(0.0)) < 1e-11);
    BOOST_TEST(std::abs(exact.radiated(exact.wall_temperature(t)) - lost) < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(gradient_is_the_derivative_of_the_temperature) {
  RadiativeWall const exact = slab();
  for (double const x : {0.0, 0.3, 0.77, 1.0}) {
    double const slope = first_derivative([&](double s) { return exact.temperature(s, 0.01); }, x, 0.01);
    BOOST_TEST(std::abs(exact.gradient(x, 0.01) - slope) < 1e-10);
  }
}

BOOST_AUTO_TEST_CASE(the_wall_cools_towards_its_environment_and_the_slab_with_it) {
  RadiativeWall const exact = slab();
  BOOST_TEST(exact.wall_temperature(0.0) == 2.0, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(exact.wall_temperature(0.04) == environment + 1.2 * std::exp(-1.0),
             boost::test_tools::tolerance(1e-14));
  for (double const x : {0.0, 0.5, 1.0})
    BOOST_TEST(std::abs(exact.temperature(x, 2.0) - environment) < 1e-14);
}

BOOST_AUTO_TEST_CASE(temperature_is_as_accurate_as_promised) {
  RadiativeWall const exact = slab();
  BOOST_TEST(exact.accuracy() < 1e-13);
  constexpr long double half_pi = 1.57079632679489661923L;
  for (double t = 0.0; t < 0.2; t += 0.013) {
    long double const T = environment + (2.0L - environment) * std::exp(-t / static_cast<long double>(0.04));
    long double const e = environment;
    long double const G =
        static_cast<long double>(radiation) / conductivity * (T * T * T * T - e * e * e * e);
    for (double x = 0.0; x <= 1.0; x += 0.0173) {
      long double const expected = T + G / half_pi * std::cos(half_pi * x);
      BOOST_TEST(std::abs(static_cast<double>(exact.temperature(x, t) - expected)) <= exact.accuracy());
    }
  }
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(
      refuses([] { RadiativeWall(-1, 2, 1, 1, 1, 1); }, "radiation must be zero or positive, found -1"));
  BOOST_TEST(refuses([] { RadiativeWall(1, 1, 1, 1, 1, 1); }, "start must be above 1, found 1"));
  BOOST_TEST(
      refuses([] { RadiativeWall(1, 2, -1, 1, 1, 1); }, "environment must be zero or positive, found -1"));
  BOOST_TEST(refuses([] { RadiativeWall(1, 2, 1, 0, 1, 1); }, "cooling_time must be positive, found 0"));
  BOOST_TEST(refuses([] { RadiativeWall(1, 2, 1, 1, 0, 1); }, "conductivity must be positive, found 0"));
  BOOST_TEST(refuses([] { RadiativeWall(1, 2, 1, 1, 1, 0); }, "density must be positive, found 0"));
  BOOST_TEST(refuses([] { slab().temperature(0.5, -1.0); }, "time must be zero or positive, found -1"));
}

BOOST_AUTO_TEST_SUITE_END()
