// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/profile.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_profile)

using namespace sphverify::exact;
using namespace sphverify::tests;

template <class Profile>
void check_derivatives(Profile const& profile) {
  for (double const x : {-0.4, 0.0, 0.13, 0.5, 0.9, 1.0}) {
    auto const value = [&](double s) { return profile.value(s); };
    auto const slope = [&](double s) { return profile.first_derivative(s); };
    BOOST_TEST(std::abs(profile.first_derivative(x) - first_derivative(value, x, 0.01)) < 1e-9);
    BOOST_TEST(std::abs(profile.second_derivative(x) - first_derivative(slope, x, 0.01)) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(derivatives_of_the_polynomials_are_those_of_their_values) {
  for (int degree = 0; degree <= 6; ++degree) check_derivatives(PolynomialProfile(degree));
}

BOOST_AUTO_TEST_CASE(derivatives_of_the_sine_are_those_of_its_value) {
  check_derivatives(SineProfile(3.0, 0.3, 2.0));
  check_derivatives(SineProfile(-1.5, 2.0, -1.0));
}

BOOST_AUTO_TEST_CASE(polynomials_are_x_to_the_degree_plus_one) {
  BOOST_TEST(PolynomialProfile(0).value(0.0) == 2.0);
  BOOST_TEST(PolynomialProfile(0).value(0.7) == 2.0);
  BOOST_TEST(PolynomialProfile(1).value(0.25) == 1.25);
  BOOST_TEST(PolynomialProfile(3).value(0.5) == 1.125);
  BOOST_TEST(PolynomialProfile(3).first_derivative(0.5) == 0.75);
  BOOST_TEST(PolynomialProfile(3).second_derivative(0.5) == 3.0);
}

BOOST_AUTO_TEST_CASE(polynomials_of_low_degree_have_no_poles_at_zero) {
  for (int degree = 0; degree <= 2; ++degree) {
    PolynomialProfile const profile(degree);
    BOOST_TEST(profile.value(0.0) == (degree == 0 ? 2.0 : 1.0));
    BOOST_TEST(profile.first_derivative(0.0) == (degree == 1 ? 1.0 : 0.0));
    BOOST_TEST(profile.second_derivative(0.0) == (degree == 2 ? 2.0 : 0.0));
  }
}

BOOST_AUTO_TEST_CASE(the_sine_has_its_offset_phase_and_wavenumber) {
  double const pi = std::acos(-1.0);
  SineProfile const profile(2.0 * pi, 0.5 * pi, 3.0);
  BOOST_TEST(profile.value(0.0) == 4.0);
  BOOST_TEST(std::abs(profile.value(0.25) - 3.0) < 1e-15);
  BOOST_TEST(std::abs(profile.first_derivative(0.25) + 2.0 * pi) < 1e-14);
  BOOST_TEST(std::abs(profile.second_derivative(0.0) + 4.0 * pi * pi) < 1e-13);
}

BOOST_AUTO_TEST_SUITE_END()
