#include "harness/measure/order.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <random>

BOOST_AUTO_TEST_SUITE(harness_measure_order)

using namespace sphverify;
using boost::test_tools::tolerance;

using Levels = std::vector<LadderLevel>;

/// One error per level, spacings halved from 0.04.
Levels halving(std::vector<double> const& errors, double round_off = 0.0) {
  Levels levels;
  double spacing = 0.04;
  for (double const error : errors) {
    levels.push_back({spacing, {error}, round_off});
    spacing *= 0.5;
  }
  return levels;
}

std::string verdict(std::vector<double> const& errors) { return observed_order(halving(errors)).verdict; }

/// Standard normal deviates, the same on every machine.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : engine_(seed) {}
  double operator()() {
    double const radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  double uniform() { return std::ldexp(static_cast<double>(engine_() >> 11) + 0.5, -53); }
  std::mt19937_64 engine_;
};

/// How often the 95% interval covers the order of a ladder with log-normal noise.
double coverage(std::size_t levels, int replicates, double noise, std::uint64_t seed) {
  constexpr int ladders = 2000;
  Normal normal(seed);
  int covered = 0;
  for (int k = 0; k < ladders; ++k) {
    double const order = 0.5 + 0.25 * (k % 8);
    Levels ladder;
    double spacing = 0.1;
    for (std::size_t n = 0; n < levels; ++n) {
      LadderLevel level{spacing, {}, 0.0};
      for (int r = 0; r < replicates; ++r) {
        level.errors.push_back(3.0 * std::pow(spacing, order) * std::exp(noise * normal()));
      }
      ladder.push_back(level);
      spacing *= n % 2 == 0 ? 0.6 : 0.45;
    }
    ObservedOrder const observed = observed_order(ladder);
    if (*observed.lower <= order && order <= *observed.upper) ++covered;
  }
  return static_cast<double>(covered) / ladders;
}

BOOST_AUTO_TEST_CASE(a_ladder_of_known_order_gives_that_order_on_its_true_uneven_spacings) {
  for (double const order : {0.5, 1.0, 1.7, 2.0, 4.0}) {
    Levels levels;
    for (int const n : {25, 40, 100, 230}) {
      double const spacing = 1.3 / n;
      levels.push_back({spacing, {7.0 * std::pow(spacing, order)}, 0.0});
    }
    ObservedOrder const observed = observed_order(levels);
    BOOST_TEST(*observed.order == order, tolerance(1e-12));
    BOOST_TEST(*observed.lower == order, tolerance(1e-7));
    BOOST_TEST(*observed.upper == order, tolerance(1e-7));
    BOOST_TEST(*observed.lower <= *observed.order);
    BOOST_TEST(*observed.order <= *observed.upper);
    BOOST_TEST(observed.pairwise.size() == 3u);
    for (Number const& p : observed.pairwise) BOOST_TEST(*p == order, tolerance(1e-12));
    BOOST_TEST(observed.verdict == "asymptotic");
    BOOST_TEST(!observed.reason.empty());
  }
}

BOOST_AUTO_TEST_CASE(the_order_is_the_least_squares_slope_and_its_interval_is_students_t) {
  // x = log2(spacing) = 0, -1, -2, -3 and y = log2(error) = 0, -1, -3, -3: slope 1.1, residual sum of squares
  // 0.7, sum of (x - mean)^2 = 5, two degrees of freedom: t = 4.302653.
  ObservedOrder const observed =
      observed_order({{1.0, {1.0}, 0.0}, {0.5, {0.5}, 0.0}, {0.25, {0.125}, 0.0}, {0.125, {0.125}, 0.0}});
  BOOST_TEST(*observed.order == 1.1, tolerance(1e-12));
  double const half_width = 4.30265273 * std::sqrt(0.7 / 2.0 / 5.0);
  BOOST_TEST(*observed.lower == 1.1 - half_width, tolerance(1e-7));
  BOOST_TEST(*observed.upper == 1.1 + half_width, tolerance(1e-7));
  BOOST_TEST(*observed.pairwise[1] == 2.0, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_constant_ladder_is_not_refined) {
  ObservedOrder const observed = observed_order(halving({0.3, 0.3, 0.3, 0.3}));
  BOOST_TEST(observed.verdict == "not-refined");
  BOOST_TEST(std::abs(*observed.order) < 1e-12);
  BOOST_TEST(verdict({0.3, 0.3 * (1.0 + 1e-7), 0.3, 0.3}) == "not-refined");
  BOOST_TEST(verdict({0.3, 0.3 * (1.0 + 1e-5), 0.3, 0.3}) != "not-refined");
}

BOOST_AUTO_TEST_CASE(a_slow_but_steady_ladder_is_neither_floored_nor_asymptotic) {
  BOOST_TEST(verdict({1.0, 0.8706, 0.7579, 0.6552}) == "pre-asymptotic");  // orders 0.20 0.20 0.21
}

BOOST_AUTO_TEST_CASE(a_ladder_whose_orders_fade_is_not_yet_asymptotic) {
  BOOST_TEST(verdict({1.0, 0.58, 0.44, 0.367}) == "pre-asymptotic");  // orders 0.79 0.40 0.26
}

BOOST_AUTO_TEST_CASE(a_plateau_is_floored) {
  BOOST_TEST(verdict({5.6e-3, 5.3e-3, 5.1e-3, 4.9e-3}) == "floored");
  BOOST_TEST(verdict({4.2e-2, 4.6e-2, 5.0e-2, 5.2e-2}) == "floored");  // grows, but ever less
  std::vector<double> errors;
  for (double const spacing : {0.1, 0.05, 0.025, 0.0125, 0.00625, 0.003125}) {
    errors.push_back(1e-3 + spacing * spacing);
  }
  BOOST_TEST(verdict(errors) == "floored");
}

BOOST_AUTO_TEST_CASE(one_small_step_after_large_ones_is_no_plateau) {
  BOOST_TEST(verdict({1.0, 0.9, 0.25, 0.24}) == "pre-asymptotic");
}

BOOST_AUTO_TEST_CASE(an_order_that_still_changes_is_pre_asymptotic) {
  BOOST_TEST(verdict({5.6e-3, 3.1e-3, 7.5e-4, 3.0e-4}) == "pre-asymptotic");
  BOOST_TEST(verdict({2.0e-3, 1.1e-3, 6.1e-4, 3.1e-4}) == "asymptotic");
}

BOOST_AUTO_TEST_CASE(an_interval_that_holds_zero_is_not_asymptotic) {
  // The last two pairwise orders are 1, the first -2: the slope is 0.1 give or take 2.
  ObservedOrder const observed = observed_order(halving({1.0, 4.0, 2.0, 1.0}));
  BOOST_TEST(*observed.lower < 0.0);
  BOOST_TEST(*observed.upper > 0.0);
  BOOST_TEST(observed.verdict == "pre-asymptotic");
}

BOOST_AUTO_TEST_CASE(errors_that_grow_are_diverging) {
  BOOST_TEST(verdict({1e-3, 2e-3, 4e-3, 8e-3}) == "diverging");
  BOOST_TEST(verdict({1e-3, 1e-3, 1e-3, 8e-3}) == "diverging");
  BOOST_TEST(*observed_order(halving({1e-3, 2e-3, 4e-3, 8e-3})).order == -1.0, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_failed_finest_level_is_diverging_however_well_the_others_converge) {
  Levels levels = halving({1.0, 0.25, 0.0625, 0.015625});
  levels.back().errors.clear();
  ObservedOrder const observed = observed_order(levels);
  BOOST_TEST(observed.verdict == "diverging");
  BOOST_TEST(*observed.order == 2.0, tolerance(1e-12));
  for (LadderLevel& level : levels) level.errors.clear();
  BOOST_TEST(observed_order(levels).verdict == "diverging");
  BOOST_TEST(!observed_order(levels).order.has_value());
}

BOOST_AUTO_TEST_CASE(a_failed_level_in_between_is_stepped_over) {
  Levels levels = halving({1.0, 0.25, 0.0625, 0.015625, 0.00390625});
  levels[2].errors.clear();
  ObservedOrder const observed = observed_order(levels);
  BOOST_TEST(*observed.order == 2.0, tolerance(1e-12));
  BOOST_TEST(observed.pairwise.size() == 3u);
  for (Number const& p : observed.pairwise) BOOST_TEST(*p == 2.0, tolerance(1e-12));
  BOOST_TEST(observed.verdict == "asymptotic");
}

BOOST_AUTO_TEST_CASE(levels_at_round_off_are_left_out_and_the_ladder_is_floored) {
  Levels levels = halving({1e-4, 2.5e-5, 6.25e-6, 3e-15, 2e-15}, 1e-14);
  ObservedOrder const observed = observed_order(levels);
  BOOST_TEST(*observed.order == 2.0, tolerance(1e-12));
  BOOST_TEST(observed.pairwise.size() == 2u);
  BOOST_TEST(observed.verdict == "floored");
  BOOST_TEST(observed_order(halving({0.0, 0.0, 0.0})).verdict == "floored");
  BOOST_TEST(observed_order(halving({1e-16, 3e-16, 2e-16}, 1e-14)).verdict == "floored");
  BOOST_TEST(!observed_order(halving({1e-16, 3e-16, 2e-16}, 1e-14)).order.has_value());
}

BOOST_AUTO_TEST_CASE(two_levels_have_an_order_but_no_interval_and_are_not_refined) {
  ObservedOrder const observed = observed_order(halving({0.4, 0.1}));
  BOOST_TEST(*observed.order == 2.0, tolerance(1e-12));
  BOOST_TEST(!observed.lower.has_value());
  BOOST_TEST(!observed.upper.has_value());
  BOOST_TEST(observed.verdict == "not-refined");
  BOOST_TEST(!observed_order(halving({0.4})).order.has_value());
  BOOST_TEST(observed_order(halving({0.4})).verdict == "not-refined");
  BOOST_TEST(observed_order({}).verdict == "not-refined");
}

BOOST_AUTO_TEST_CASE(the_unit_of_the_spacing_does_not_matter) {
  Levels levels = halving({0.9, 0.5, 0.22, 0.12});
  ObservedOrder const one = observed_order(levels);
  for (LadderLevel& level : levels) level.spacing *= 1e-9;
  ObservedOrder const other = observed_order(levels);
  BOOST_TEST(*other.order == *one.order, tolerance(1e-10));
  BOOST_TEST(*other.lower == *one.lower, tolerance(1e-10));
  BOOST_TEST(other.verdict == one.verdict);
}

BOOST_AUTO_TEST_CASE(intervals_cover_the_true_order_in_95_percent_of_noisy_ladders) {
  for (std::size_t const levels : {4u, 5u, 6u}) {
    double const covered = coverage(levels, 1, 0.15, 40 + levels);
    BOOST_TEST_MESSAGE(levels << " levels: " << covered);
    BOOST_TEST((covered > 0.935 && covered < 0.965), levels << " levels: " << covered);
  }
}

BOOST_AUTO_TEST_CASE(with_seeds_intervals_cover_the_true_order_in_at_least_95_percent) {
  for (std::size_t const levels : {4u, 5u, 6u}) {
    double const covered = coverage(levels, 5, 0.4, 50 + levels);
    BOOST_TEST_MESSAGE(levels << " levels of 5 seeds: " << covered);
    BOOST_TEST(covered >= 0.95);
    BOOST_TEST(covered < 1.0);  // nor are they so wide that they say nothing
  }
}

BOOST_AUTO_TEST_CASE(a_large_spread_of_seeds_widens_the_interval_of_a_lucky_straight_line) {
  double const s = 0.4;
  Levels levels;
  for (double const spacing : {1.0, 0.5, 0.25})
    levels.push_back({spacing, {spacing * (1.0 - s), spacing * (1.0 + s)}, 0.0});
  ObservedOrder const observed = observed_order(levels);
  BOOST_TEST(*observed.order == 1.0, tolerance(1e-12));
  // Each mean's logarithm has the variance s^2; Student's t for 3 degrees of freedom.
  double const half_width = 3.18244631 * s / (std::log(2.0) * std::numbers::sqrt2);
  BOOST_TEST(*observed.upper - 1.0 == half_width, tolerance(1e-7));
  BOOST_TEST(1.0 - *observed.lower == half_width, tolerance(1e-7));
  BOOST_TEST(observed.verdict == "pre-asymptotic");  // such an interval includes 0
}

BOOST_AUTO_TEST_CASE(a_level_with_seeds_counts_by_its_mean_error) {
  Levels levels = halving({4.0, 2.0, 1.0});
  levels[1].errors = {1.0, 2.0, 3.0};
  BOOST_TEST(*observed_order(levels).pairwise[0] == 1.0, tolerance(1e-12));
  BOOST_TEST(*observed_order(levels).pairwise[1] == 1.0, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(the_rules_that_describe_prints_name_every_verdict) {
  for (char const* word : {"asymptotic", "pre-asymptotic", "floored", "diverging", "not-refined"})
    BOOST_TEST(verdict_rules.find(word) != std::string_view::npos);
}

BOOST_AUTO_TEST_SUITE_END()
