// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/barenblatt.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_barenblatt)

using namespace sphverify::exact;
using namespace sphverify::tests;

constexpr double exponents[] = {1.3, 2.0, 3.0, 4.5};
constexpr double constant = 0.7;
constexpr double start_time = 0.4;

Barenblatt pulse(double m) { return Barenblatt(m, constant, start_time); }

// Up to 0.8 of the front a step of 0.004 front gives a truncation error below 1e-7 of the rates, which are of
// order 1.
BOOST_AUTO_TEST_CASE(temperature_solves_the_nonlinear_equation_behind_the_front) {
  for (double const m : exponents) {
    Barenblatt const exact = pulse(m);
    for (double const t : {0.0, 0.3, 2.0}) {
      double const front = exact.front(t);
      for (double x = -0.8 * front; x < 0.81 * front; x += 0.1 * front) {
        double const rate = first_derivative([&](double s) { return exact.temperature(x, s); }, t, 0.002);
        auto power = [&](double s) { return std::pow(exact.temperature(s, t), m); };
        double const curvature = second_derivative(power, x, 0.004 * front);
        BOOST_TEST(std::abs(rate - curvature) < 1e-7, "m = " << m << ", x = " << x << ", t = " << t);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(quadratic_case_is_the_parabola_of_the_textbooks) {
  Barenblatt const exact(2.0, 1.0, 1.0);  // tau^(-1/3) (1 - x^2 tau^(-2/3) / 12)
  BOOST_TEST(exact.temperature(0.0, 0.0) == 1.0, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(exact.temperature(1.0, 0.0) == 11.0 / 12.0, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(exact.temperature(2.0, 7.0) == 0.5 * (1.0 - 4.0 / 4.0 / 12.0),
             boost::test_tools::tolerance(1e-15));
  BOOST_TEST(exact.front(7.0) == 2.0 * std::sqrt(12.0), boost::test_tools::tolerance(1e-15));
  BOOST_TEST(exact.gradient(3.0, 0.0) == -0.5, boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(energy_is_the_same_at_all_times_and_equals_its_closed_form) {
  for (double const m : exponents) {
    Barenblatt const exact = pulse(m);
    for (double const t : {-0.2, 0.0, 1.0, 50.0}) {
      double const half = integral([&](double x) { return exact.temperature(x, t); }, 0.0, exact.front(t));
      BOOST_TEST(2.0 * half == exact.total_energy(), boost::test_tools::tolerance(1e-10));
    }
  }
}

BOOST_AUTO_TEST_CASE(energy_beyond_a_point_grows_by_the_flux_through_it) {
  for (double const m : exponents) {
    Barenblatt const exact = pulse(m);
    double const x = 0.6 * exact.front(0.0);
    auto beyond = [&](double t) {
      return integral([&](double s) { return exact.temperature(s, t); }, x, exact.front(t));
    };
    double const passed = integral([&](double t) { return exact.flux(x, t); }, 0.0, 1.5);
    BOOST_TEST(beyond(1.5) - beyond(0.0) == passed, boost::test_tools::tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(flux_is_the_negative_derivative_of_the_power) {
  for (double const m : exponents) {
    Barenblatt const exact = pulse(m);
    for (double const x : {-0.5, 0.0, 0.4}) {
      double const expected =
          -first_derivative([&](double s) { return std::pow(exact.temperature(s, 0.3), m); }, x, 0.005);
      BOOST_TEST(std::abs(exact.flux(x, 0.3) - expected) < 1e-10);
    }
  }
}

BOOST_AUTO_TEST_CASE(gradient_is_the_derivative_of_the_temperature_and_zero_beyond_the_front) {
  for (double const m : exponents) {
    Barenblatt const exact = pulse(m);
    for (double const x : {-0.5, 0.0, 0.4}) {
      double const expected = first_derivative([&](double s) { return exact.temperature(s, 0.3); }, x, 0.005);
      BOOST_TEST(std::abs(exact.gradient(x, 0.3) - expected) < 1e-10);
      double const conducted = -exact.conductivity(exact.temperature(x, 0.3)) * expected;
      BOOST_TEST(std::abs(exact.flux(x, 0.3) - conducted) < 1e-10);
    }
    double const front = exact.front(0.3);
    for (double const x : {-2.0 * front, front, 1.5 * front}) {
      BOOST_TEST(exact.gradient(x, 0.3) == 0.0);
      BOOST_TEST(exact.flux(x, 0.3) == 0.0);
    }
    BOOST_TEST(exact.gradient(0.999 * front, 0.3) < 0.0);
  }
}

BOOST_AUTO_TEST_CASE(temperature_is_positive_behind_the_front_and_zero_from_it_on) {
  for (double const m : exponents) {
    Barenblatt const exact = pulse(m);
    for (double const t : {0.0, 0.3, 2.0}) {
      double const front = exact.front(t);
      for (double const side : {-1.0, 1.0}) {
        BOOST_TEST(exact.temperature(side * front * (1.0 - 1e-13), t) > 0.0);
        BOOST_TEST(exact.temperature(side * front * (1.0 + 1e-13), t) == 0.0);
        BOOST_TEST(exact.temperature(side * front * 10.0, t) == 0.0);
      }
    }
  }
}

// Darcy's law for the front: it moves at flux / temperature, the limit of which is -m/(m-1) d(T^(m-1))/dx.
BOOST_AUTO_TEST_CASE(front_moves_at_the_speed_that_the_profile_drives) {
  for (double const m : exponents) {
    Barenblatt const exact = pulse(m);
    double const t = 0.5;
    double const speed = first_derivative([&](double s) { return exact.front(s); }, t, 0.005);
    double const x = exact.front(t) * (1.0 - 1e-6);
    auto pressure = [&](double s) { return m / (m - 1.0) * std::pow(exact.temperature(s, t), m - 1.0); };
    double const slope = -first_derivative(pressure, x, 1e-7 * x);
    BOOST_TEST(slope == speed, boost::test_tools::tolerance(1e-5));
  }
}

BOOST_AUTO_TEST_CASE(conductivity_is_the_derivative_of_the_power_and_zero_without_heat) {
  Barenblatt const exact = pulse(3.0);
  BOOST_TEST(exact.conductivity(0.5) == 0.75);
  BOOST_TEST(exact.conductivity(0.0) == 0.0);
  BOOST_TEST(exact.conductivity(-0.5) == 0.0);
}

BOOST_AUTO_TEST_CASE(temperature_is_as_accurate_as_promised) {
  for (double const exponent : exponents) {
    Barenblatt const exact = pulse(exponent);
    BOOST_TEST(exact.accuracy() < 1e-11);
    long double const m = exponent;
    long double const a = 1.0L / (m + 1.0L);
    long double const k = (m - 1.0L) / (2.0L * m * (m + 1.0L));
    for (double const t : {0.0, 0.3, 2.0}) {
      long double const tau = static_cast<long double>(start_time) + t;
      for (double fraction = 0.0; fraction < 0.9999; fraction += 0.0099) {
        double const x = fraction * exact.front(t);
        long double const base = constant - k * x * x * std::pow(tau, -2.0L * a);
        long double const expected = std::pow(tau, -a) * std::pow(base, 1.0L / (m - 1.0L));
        BOOST_TEST(std::abs(static_cast<double>(exact.temperature(x, t) - expected)) <= exact.accuracy());
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(refuses([] { Barenblatt(1, 1, 1); }, "exponent must be above 1, found 1"));
  BOOST_TEST(refuses([] { Barenblatt(2, 0, 1); }, "constant must be positive, found 0"));
  BOOST_TEST(refuses([] { Barenblatt(2, 1, -3); }, "start_time must be positive, found -3"));
  BOOST_CHECK_THROW(Barenblatt(std::numeric_limits<double>::quiet_NaN(), 1, 1), std::invalid_argument);
  BOOST_TEST(refuses([] { Barenblatt(2, 1, 1).temperature(0.0, -1.0); }, "time must be above -1, found -1"));
  BOOST_CHECK_THROW(Barenblatt(2, 1, 1).front(-2.0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
