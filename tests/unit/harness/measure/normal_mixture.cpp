// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/normal_mixture.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

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

BOOST_AUTO_TEST_CASE(the_normal_distribution_is_that_of_the_error_function_everywhere) {
  NormalMixture m;
  m.add(2.0, 0.5, 3.0);
  double worst = 0.0;
  for (int k = -7000; k <= 7000; ++k) {
    double const z = 1e-3 * k + 1.23e-5;
    double const known = std::abs(z) >= 6.0 ? (z > 0.0 ? 1.0 : 0.0) : 0.5 * std::erfc(-z / std::sqrt(2.0));
    worst = std::max(worst, std::abs(m.probability_below(0.5 + 3.0 * z) - known));
  }
  BOOST_TEST(worst < 1e-12);
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

/// Many components in two heaps far apart, every seventh of them a step.
NormalMixture two_heaps(double weight_of_steps) {
  NormalMixture m;
  for (int k = 0; k < 3000; ++k) {
    double const at = k % 2 == 0 ? 1.0 + 1e-4 * k : 40.0 - 3e-3 * k;
    bool const is_step = k % 7 == 0;
    m.add(is_step ? weight_of_steps : 1.0 + 0.1 * (k % 5), at, is_step ? 0.0 : 0.05 + 1e-3 * (k % 11));
  }
  return m;
}

BOOST_AUTO_TEST_CASE(quantiles_of_many_components_are_where_the_probability_says) {
  for (double const steps : {0.0, 1.0, 50.0}) {
    NormalMixture const m = two_heaps(steps);
    for (double const p : {1e-4, 0.01, 0.025, 0.3, 0.499, 0.5, 0.501, 0.9, 0.99, 1.0 - 1e-4}) {
      double const q = m.quantile(p);
      BOOST_TEST_CONTEXT("weight of steps " << steps << ", p " << p << ", quantile " << q) {
        BOOST_TEST(m.probability_below(q - 2e-7) <= p);
        BOOST_TEST(m.probability_below(q + 2e-7) >= p);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(needles_in_the_density_do_not_stop_the_search_for_a_quantile) {
  NormalMixture m;
  for (int k = 0; k < 1000; ++k) m.add(1.0, 1e-5 * k, 1e-8);
  for (int k = 0; k < 1000; ++k) m.add(1.0, 1e-5 * k, 1e-5);
  for (int k = 1; k < 200; ++k) {
    double const p = k / 200.0 + 1e-5 * k;
    if (p >= 1.0) break;
    double const q = m.quantile(p);
    BOOST_TEST_CONTEXT("p " << p << ", quantile " << q) {
      BOOST_TEST(m.probability_below(q - 2e-7) <= p);
      BOOST_TEST(m.probability_below(q + 2e-7) >= p);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
