// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/require.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_require)

using namespace sphverify::exact;
using sphverify::tests::refuses;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

BOOST_AUTO_TEST_CASE(what_passes_is_returned_unchanged) {
  BOOST_TEST(require_finite("mean", -2.5) == -2.5);
  BOOST_TEST(require_positive("density", 1e-300) == 1e-300);
  BOOST_TEST(require_not_negative("time", 0.0) == 0.0);
  BOOST_TEST(require_above("exponent", 1.5, 1.0) == 1.5);
  BOOST_TEST(require_positive("mode number", 1) == 1);
}

BOOST_AUTO_TEST_CASE(messages_name_the_quantity_what_was_found_and_what_is_expected) {
  BOOST_TEST(
      refuses([] { require_positive("conductivity", -1.0); }, "conductivity must be positive, found -1"));
  BOOST_TEST(refuses([] { require_positive("density", 0.0); }, "density must be positive, found 0"));
  BOOST_TEST(
      refuses([] { require_not_negative("time", -0.5); }, "time must be zero or positive, found -0.5"));
  BOOST_TEST(refuses([] { require_above("exponent", 1.0, 1.0); }, "exponent must be above 1, found 1"));
  BOOST_TEST(
      refuses([] { require_above("exponent", nan, 1.0); }, "exponent must be above 1, found no number"));
  BOOST_TEST(refuses([] { require_positive("density", nan); }, "density must be positive, found no number"));
  BOOST_TEST(
      refuses([] { require_not_negative("time", nan); }, "time must be zero or positive, found no number"));
  BOOST_TEST(
      refuses([] { require_finite("flux", infinity); }, "flux must be finite, found an infinite number"));
  BOOST_TEST(refuses([] { require_positive("mode number", 0); }, "mode number must be 1 or more, found 0"));
}

BOOST_AUTO_TEST_CASE(infinities_and_nan_never_pass) {
  for (double const value : {infinity, nan}) {
    BOOST_CHECK_THROW(require_finite("value", value), std::invalid_argument);
    BOOST_CHECK_THROW(require_positive("value", value), std::invalid_argument);
    BOOST_CHECK_THROW(require_not_negative("value", value), std::invalid_argument);
    BOOST_CHECK_THROW(require_above("value", value, 1.0), std::invalid_argument);
  }
  BOOST_CHECK_THROW(require_finite("value", -infinity), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
