// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/gresho.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_gresho)

using namespace sphverify::exact;
using namespace sphverify::tests;

// The formulas as Liska & Wendroff print them, for a central pressure of 5.
BOOST_AUTO_TEST_CASE(known_values) {
  Gresho const vortex(5.0);
  BOOST_TEST(vortex.velocity(0.1) == 0.5, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(vortex.velocity(0.2) == 1.0, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(vortex.velocity(0.3) == 0.5, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(vortex.velocity(0.5) == 0.0);
  BOOST_TEST(vortex.pressure(0.0) == 5.0);
  BOOST_TEST(vortex.pressure(0.2) == 5.5, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(vortex.pressure(0.3) == 9.0 + 4.0 * std::log(1.5) + 12.5 * 0.09 - 6.0,
             boost::test_tools::tolerance(1e-14));
  BOOST_TEST(vortex.pressure(0.5) == 3.0 + 4.0 * std::log(2.0), boost::test_tools::tolerance(1e-15));
  BOOST_TEST(vortex.angular_velocity(0.0) == 5.0);
  BOOST_TEST(vortex.velocity(0.0) == 0.0);
}

BOOST_AUTO_TEST_CASE(pressure_holds_every_circle) {
  Gresho const vortex(0.7);
  auto const pressure = [&](double r) { return vortex.pressure(r); };
  for (double const r : {0.02, 0.1, 0.19, 0.21, 0.3, 0.39, 0.41, 0.7}) {
    double const v = vortex.velocity(r);
    BOOST_TEST(std::abs(first_derivative(pressure, r, 1e-3) - v * v / r) < 1e-9, "r = " << r);
  }
}

BOOST_AUTO_TEST_CASE(velocity_and_pressure_are_continuous) {
  Gresho const vortex(5.0);
  for (double const r : {0.2, 0.4}) {
    BOOST_TEST(std::abs(vortex.velocity(r * (1.0 + 1e-12)) - vortex.velocity(r)) < 1e-10);
    BOOST_TEST(std::abs(vortex.pressure(r * (1.0 + 1e-12)) - vortex.pressure(r)) < 1e-10);
  }
}

BOOST_AUTO_TEST_CASE(largest_mach_number_is_the_one_asked_for) {
  for (double const gamma : {1.4, 5.0 / 3.0}) {
    for (double const mach : {0.01, 0.36, 1.0}) {
      Gresho const vortex(Gresho::central_pressure(gamma, mach));
      double largest = 0.0;
      for (int i = 0; i <= 1000; ++i) {
        double const r = 0.0005 * i;
        largest =
            std::max(largest, vortex.velocity(r) / std::sqrt(gamma * vortex.pressure(r) / Gresho::density));
      }
      BOOST_TEST(largest == mach, boost::test_tools::tolerance(1e-12));
    }
  }
  BOOST_TEST(Gresho::central_pressure(1.4, 1.0 / std::sqrt(1.4 * 5.5)) == 5.0,
             boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(fields_are_as_accurate_as_promised) {
  for (double const centre : {1e-3, 5.0, 1e4}) {
    Gresho const vortex(centre);
    BOOST_TEST(vortex.accuracy() < 1e-11);
    for (double r = 0.003; r < 0.6; r += 0.007) {
      long double const s = r;
      long double const v = s <= 0.2L ? 5 * s : s <= 0.4L ? 2 - 5 * s : 0;
      long double const P = centre + (s <= 0.2L   ? 12.5L * s * s
                                      : s <= 0.4L ? 4 + 12.5L * s * s - 20 * s + 4 * std::log(5 * s)
                                                  : 4 * std::log(2.0L) - 2);
      BOOST_TEST(std::abs(static_cast<double>(vortex.velocity(r) - v)) <= vortex.accuracy());
      BOOST_TEST(std::abs(static_cast<double>(vortex.pressure(r) / P - 1)) <= vortex.accuracy());
    }
  }
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(refuses([] { Gresho(0); }, "pressure in the centre must be positive, found 0"));
  BOOST_TEST(refuses([] { Gresho::central_pressure(1, 0.1); }, "gamma must be above 1, found 1"));
  BOOST_TEST(refuses([] { Gresho::central_pressure(1.4, 0); }, "mach must be positive, found 0"));
  BOOST_TEST(refuses([] { Gresho::central_pressure(2, 1); },
                     "mach must be below 1 for a positive pressure, found 1"));
  BOOST_TEST(refuses([] { Gresho(5).pressure(-1); }, "radius must be zero or positive, found -1"));
  BOOST_CHECK_THROW(Gresho{std::numeric_limits<double>::quiet_NaN()}, std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
