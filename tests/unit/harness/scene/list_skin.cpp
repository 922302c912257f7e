// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/scene/list_skin.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

BOOST_AUTO_TEST_SUITE(harness_scene_list_skin)

using namespace sphverify;

/// Cost of a place over its sweeps without a skin, counted while particles move straight on: pairs of the
/// list, and the list as often as they have outrun it.
double counted_cost(double skin, double movement, int dimension) {
  int served = 1;  // the place where it was found
  for (double moved = movement; moved <= skin * (1.0 + 1e-12); moved += movement) ++served;
  return std::pow(1.0 + skin, dimension) * (1.0 + list_cost / served);
}

BOOST_AUTO_TEST_CASE(chosen_skin_costs_hardly_more_than_any_other) {
  for (int const dimension : {1, 2, 3}) {
    for (double movement = 1e-3; movement < 2.0; movement *= 1.07) {
      double least = std::numeric_limits<double>::infinity();
      for (int places = 0; places < 60; ++places) {
        least = std::min(least, counted_cost(places * movement, movement, dimension));
      }
      double const chosen = counted_cost(cheapest_skin(movement, dimension), movement, dimension);
      BOOST_TEST(chosen < 1.1 * least, "dimension " << dimension << ", movement " << movement);
    }
  }
}

BOOST_AUTO_TEST_CASE(skin_of_slow_particles_is_that_of_the_leading_order) {
  // Dim s^2 = list_cost u for small s.
  for (int const dimension : {1, 2, 3}) {
    BOOST_TEST(cheapest_skin(1e-8, dimension) == std::sqrt(list_cost * 1e-8 / dimension),
               boost::test_tools::tolerance(1e-3));
  }
}

BOOST_AUTO_TEST_CASE(what_has_no_speed_or_too_much_has_no_skin) {
  for (int const dimension : {1, 2, 3}) {
    BOOST_TEST(cheapest_skin(0.0, dimension) == 0.0);
    BOOST_TEST(cheapest_skin(0.5, dimension) == 0.0);
    BOOST_TEST(cheapest_skin(3.0, dimension) == 0.0);
    BOOST_TEST(cheapest_skin(std::numeric_limits<double>::infinity(), dimension) == 0.0);
    BOOST_TEST(cheapest_skin(std::numeric_limits<double>::quiet_NaN(), dimension) == 0.0);
  }
}

BOOST_AUTO_TEST_SUITE_END()
