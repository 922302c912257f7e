// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/error_law.hpp"

#include <gsl/gsl_cdf.h>

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "harness/measure/adapted_cells.hpp"
#include "harness/measure/scatter.hpp"

BOOST_AUTO_TEST_SUITE(harness_measure_error_law)

using namespace sphverify;
using boost::test_tools::tolerance;

std::vector<LevelError> ladder(std::vector<double> const& errors) {
  std::vector<LevelError> levels;
  double spacing = 0.04;
  for (double const e : errors) {
    levels.push_back({spacing, e, 1, 0.0});
    spacing *= 0.5;
  }
  return levels;
}

LawEvidence evidence(std::vector<LevelError> const& levels, LawKind kind) {
  for (LawEvidence const& law : weigh_laws(levels)) {
    if (law.kind == kind) return law;
  }
  return {};
}

BOOST_AUTO_TEST_CASE(cells_follow_a_peak_that_is_a_million_times_narrower_than_the_interval) {
  double const centre = 0.3141, width = 1e-6;
  auto const cells = adapted_cells(-3.0, 3.0, [&](double u) {
    double const z = (u - centre) / width;
    return -2.0 * std::log1p(z * z);  // tails of a power, as those of a scatter that is not known
  });
  double mass = 0.0, total_width = 0.0, first_moment = 0.0;
  for (Cell const& cell : cells) {
    mass += std::exp(cell.log_mass);
    first_moment += cell.centre * std::exp(cell.log_mass);
    total_width += cell.width;
  }
  BOOST_TEST(total_width == 6.0, tolerance(1e-12));
  BOOST_TEST(mass == 0.5 * std::acos(-1.0) * width, tolerance(0.05));
  BOOST_TEST(first_moment / mass == centre, tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(the_scatter_without_replicates_is_integrated_as_a_plain_sum_does) {
  Scatter const scatter(ladder({1.0, 0.5, 0.3, 0.1}));
  ScatterMarginal const marginal(scatter, 3.0);
  for (double const rss : {1e-6, 1e-3, 0.2}) {
    // From 1e-5 to 2, uniform in the logarithm, on a grid 200 times finer; a constant factor does not matter.
    auto const fine = [](double r) {
      double sum = 0.0;
      for (int k = 0; k < 6000; ++k) {
        double const log_sigma = -11.5 + 12.2 * (k + 0.5) / 6000.0;
        sum += std::exp(-3.0 * log_sigma - 0.5 * r * std::exp(-2.0 * log_sigma));
      }
      return std::log(sum);
    };
    BOOST_TEST(marginal(rss) - marginal(0.01) == fine(rss) - fine(0.01), tolerance(0.02));
  }
}

BOOST_AUTO_TEST_CASE(replicates_tell_the_scatter_of_their_mean) {
  // Ten levels of five seeds that scatter by 0.2: their means' sigma is 0.2 / sqrt(5).
  std::vector<LevelError> levels;
  for (int k = 0; k < 10; ++k) levels.push_back({std::pow(0.5, k), 1.0, 5, 4 * 0.04});
  Scatter const scatter(levels);
  double total = 0.0, near = 0.0;
  for (std::size_t k = 0; k < scatter.log_sigma().size(); ++k) {
    double const weight = std::exp(scatter.log_weight()[k]);
    total += weight;
    if (std::abs(scatter.log_sigma()[k] - std::log(0.2 / std::sqrt(5.0))) < 0.5) near += weight;
  }
  BOOST_TEST(near / total > 0.7);
}

BOOST_AUTO_TEST_CASE(of_a_pure_power_the_order_has_students_distribution) {
  // y = log2(error) = 0, -1, -2.1, -3 over x = 0, -1, -2, -3: slope 1.01, mean -1.525, sum of squares of the
  // rest 0.007, two degrees of freedom.
  LawEvidence const law = evidence(ladder({1.0, 0.5, std::pow(2.0, -2.1), 0.125}), LawKind::power);
  double const scale = std::sqrt(0.007 / 2.0 / 5.0);
  BOOST_TEST(law.order.quantile(0.5) == 1.01, tolerance(1e-6));
  for (double const p : {0.05, 0.2, 0.8, 0.95})
    BOOST_TEST(law.order.quantile(p) - 1.01 == scale * gsl_cdf_tdist_Pinv(p, 2.0), tolerance(0.06));
  BOOST_TEST(law.best.coefficient == std::pow(2.0, -1.525 - 1.5 * 1.01),
             tolerance(1e-6));  // at the finest level
  BOOST_TEST(law.best.exponent == 1.01, tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(on_a_floor_order_and_floor_are_distributed_as_a_plain_sum_over_a_fine_grid_says) {
  std::vector<double> const errors{1.0, 0.56, 0.33, 0.24, 0.18};
  LawEvidence const law = evidence(ladder(errors), LawKind::floor);
  // p, log odds of the floor at the finest level, and sigma, each uniform; log A in closed form.
  std::vector<std::pair<double, double>> orders, shares;
  double total = 0.0;
  std::vector<double> below_order(201, 0.0), below_share(201, 0.0);
  for (int a = 0; a < 300; ++a) {
    double const p = 0.05 + 7.95 * (a + 0.5) / 300.0;
    for (int b = 0; b < 300; ++b) {
      double const odds = -7.0 + 24.0 * (b + 0.5) / 300.0;
      double const share = 1.0 / (1.0 + std::exp(-odds));
      double mean = 0.0, squares = 0.0;
      for (std::size_t i = 0; i < errors.size(); ++i) {
        double const d = std::pow(2.0, static_cast<double>(errors.size() - 1 - i));
        double const v = std::log(errors[i]) - std::log(share + (1.0 - share) * std::pow(d, p));
        mean += v / 5.0;
        squares += v * v;
      }
      double const rss = squares - 5.0 * mean * mean;
      double weight = 0.0;
      for (int c = 0; c < 60; ++c) {
        double const log_sigma = -11.5 + 12.2 * (c + 0.5) / 60.0;
        weight += std::exp(-4.0 * log_sigma - 0.5 * rss * std::exp(-2.0 * log_sigma));
      }
      total += weight;
      for (int k = 0; k <= 200; ++k) {
        if (p <= 0.04 * k) below_order[k] += weight;
        if (share <= 0.005 * k) below_share[k] += weight;
      }
    }
  }
  for (int const k : {20, 25, 30, 40, 60})
    BOOST_TEST(law.order.probability_below(0.04 * k) == below_order[k] / total, tolerance(0.15));
  for (int const k : {80, 120, 160})
    BOOST_TEST(std::abs(law.floor_share.probability_below(0.005 * k) - below_share[k] / total) < 0.05);
}

BOOST_AUTO_TEST_CASE(each_law_is_the_likeliest_of_its_own_ladder) {
  auto const likeliest = [](auto const& error_at) {
    std::vector<LevelError> levels;
    for (int k = 0; k < 6; ++k) {
      double const d = std::pow(0.5, k);
      levels.push_back({d, error_at(d, k), 1, 0.0});
    }
    auto const laws = weigh_laws(levels);
    LawEvidence const* best = &laws.front();
    double total = 0.0;
    for (LawEvidence const& law : laws) {
      total += law.probability;
      if (law.probability > best->probability) best = &law;
    }
    BOOST_TEST(total == 1.0, tolerance(1e-12));
    return *best;
  };
  LawEvidence const first = likeliest([](double d, int) { return 3.0 * d * (1.0 + 0.8 * d); });
  BOOST_TEST((first.kind == LawKind::next_first));
  BOOST_TEST(first.best.exponent == 1.0, tolerance(0.01));
  BOOST_TEST(first.best.next_coefficient * 32.0 == 0.8,
             tolerance(0.05));  // d of the best is in finest spacings
  LawEvidence const second = likeliest([](double d, int) { return d * d * (1.0 - 0.5 * d * d); });
  BOOST_TEST((second.kind == LawKind::next_second));
  LawEvidence const floor = likeliest([](double d, int) { return 0.02 + std::pow(d, 1.5); });
  BOOST_TEST((floor.kind == LawKind::floor));
  BOOST_TEST(floor.best.floor == 0.02, tolerance(0.01));
  BOOST_TEST(floor.best.exponent == 1.5, tolerance(0.01));
  BOOST_TEST(floor.local_order.quantile(0.5) == 1.5 / (1.0 + 0.02 / std::pow(1.0 / 32.0, 1.5)),
             tolerance(0.02));
  LawEvidence const alternating =
      likeliest([](double d, int k) { return d * (k % 2 == 0 ? 3.0 : 1.0 / 3.0); });
  BOOST_TEST((alternating.kind == LawKind::alternation));
  BOOST_TEST(alternating.best.exponent == 1.0, tolerance(0.01));
}

BOOST_AUTO_TEST_SUITE_END()
