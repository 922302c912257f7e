#include "harness/measure/normal_mixture.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(harness_measure_normal_mixture)

using namespace sphverify;
using boost::test_tools::tolerance;

BOOST_AUTO_TEST_CASE(one_normal_distribution_has_its_known_quantiles) {
  NormalMixture m;
  m.add(0.3, 2.0, 0.5);
  BOOST_TEST(m.quantile(0.5) == 2.0, tolerance(1e-6));
  BOOST_TEST(m.quantile(0.975) == 2.0 + 1.959963985 * 0.5, tolerance(1e-6));
  BOOST_TEST(m.quantile(0.025) == 2.0 - 1.959963985 * 0.5, tolerance(1e-6));
  BOOST_TEST(m.probability_below(2.5) == 0.841344746, tolerance(1e-8));
}

BOOST_AUTO_TEST_CASE(weights_count_whatever_they_sum_to) {
  NormalMixture m;
  m.add(6.0, -1.0, 0.01);
  m.add(2.0, 5.0, 0.01);
  m.add(0.0, 100.0, 1.0);
  BOOST_TEST(m.probability_below(0.0) == 0.75, tolerance(1e-12));
  BOOST_TEST(m.quantile(0.5) < 0.0);
  BOOST_TEST(m.quantile(0.8) > 4.9);
  NormalMixture both;
  both.add(m, 0.5);
  both.add(4.0, 10.0, 0.01);
  BOOST_TEST(both.probability_below(7.0) == 0.5, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(known_numbers_are_steps) {
  NormalMixture m;
  m.add(1.0, 1.0, 0.0);
  m.add(1.0, 3.0, 0.0);
  BOOST_TEST(m.probability_below(0.99) == 0.0);
  BOOST_TEST(m.probability_below(1.0) == 0.5);
  BOOST_TEST(m.quantile(0.25) == 1.0, tolerance(1e-6));
  BOOST_TEST(m.quantile(0.75) == 3.0, tolerance(1e-6));
  NormalMixture one;
  one.add(1.0, -2.0, 0.0);
  BOOST_TEST(one.quantile(0.1) == -2.0, tolerance(1e-6));
  BOOST_TEST(NormalMixture().is_empty());
}

BOOST_AUTO_TEST_SUITE_END()
