#include "harness/scene/list_skin.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

BOOST_AUTO_TEST_SUITE(harness_scene_list_skin)

using namespace sphverify;

/// Of one evaluation, over its sweeps without a skin; 1 + list_cost where a list serves one evaluation only.
double cost(double skin, double movement, int dimension) {
  double const evaluations = std::max(1.0, skin / movement);
  return std::pow(1.0 + skin, dimension) * (1.0 + list_cost / evaluations);
}

BOOST_AUTO_TEST_CASE(nothing_costs_less_than_the_cheapest_skin) {
  for (int const dimension : {1, 2, 3}) {
    for (double movement = 1e-6; movement < 1.0; movement *= 1.3) {
      double const chosen = cost(cheapest_skin(movement, dimension), movement, dimension);
      double least = cost(0.0, movement, dimension);
      for (double skin = 1e-5; skin < 3.0; skin *= 1.01) {
        least = std::min(least, cost(skin, movement, dimension));
      }
      BOOST_TEST(chosen <= least * (1.0 + 1e-9), "dimension " << dimension << ", movement " << movement);
      BOOST_TEST(chosen >= least * (1.0 - 1e-4));
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
    BOOST_TEST(cheapest_skin(1.0, dimension) == 0.0);
    BOOST_TEST(cheapest_skin(std::numeric_limits<double>::infinity(), dimension) == 0.0);
    BOOST_TEST(cheapest_skin(std::numeric_limits<double>::quiet_NaN(), dimension) == 0.0);
  }
}

BOOST_AUTO_TEST_SUITE_END()
