// SPDX-License-Identifier: GPL-3.0-or-later
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

ObservedOrder observed_at(std::vector<double> const& resolutions, std::vector<double> const& errors) {
  Levels levels;
  for (std::size_t k = 0; k < errors.size(); ++k) levels.push_back({1.0 / resolutions[k], {errors[k]}, 0.0});
  return observed_order(levels);
}

std::vector<double> doublings(double first, std::size_t count) {
  std::vector<double> resolutions{first};
  while (resolutions.size() < count) resolutions.push_back(2.0 * resolutions.back());
  return resolutions;
}

BOOST_AUTO_TEST_CASE(a_ladder_of_known_order_gives_that_order_on_its_true_uneven_spacings) {
  for (double const order : {0.5, 1.0, 1.7, 2.0, 4.0}) {
    Levels levels;
    for (int const n : {25, 40, 100, 230}) {
      double const spacing = 1.3 / n;
      levels.push_back({spacing, {7.0 * std::pow(spacing, order)}, 0.0});
    }
    ObservedOrder const observed = observed_order(levels);
    BOOST_TEST(*observed.order == order, tolerance(1e-4));
    BOOST_TEST(*observed.lower == order, tolerance(1e-3));
    BOOST_TEST(*observed.upper == order, tolerance(1e-3));
    BOOST_TEST(*observed.lower <= *observed.order);
    BOOST_TEST(*observed.order <= *observed.upper);
    BOOST_TEST(observed.pairwise.size() == 3u);
    for (Number const& p : observed.pairwise) BOOST_TEST(*p == order, tolerance(1e-12));
    BOOST_TEST(observed.verdict == "asymptotic");
    BOOST_TEST(!observed.reason.empty());
  }
}

BOOST_AUTO_TEST_CASE(a_constant_ladder_is_not_refined) {
  ObservedOrder const observed = observed_order(halving({0.3, 0.3, 0.3, 0.3}));
  BOOST_TEST(observed.verdict == "not-refined");
  BOOST_TEST(!observed.order.has_value());
  BOOST_TEST(verdict({0.3, 0.3 * (1.0 + 1e-7), 0.3, 0.3}) == "not-refined");
  BOOST_TEST(verdict({0.3, 0.3 * (1.0 + 1e-5), 0.3, 0.3}) != "not-refined");
}

BOOST_AUTO_TEST_CASE(a_slow_but_steady_ladder_is_neither_floored_nor_asymptotic) {
  ObservedOrder const observed =
      observed_order(halving({1.0, 0.8706, 0.7579, 0.6552}));  // orders 0.20 0.20 0.21
  BOOST_TEST(observed.verdict == "pre-asymptotic");
  BOOST_TEST(observed.reason == "the error goes down steadily, but slowly");
  BOOST_TEST((*observed.lower < 0.2 && *observed.upper > 0.2));
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
  BOOST_TEST(verdict({2.00e-3, 1.08e-3, 5.63e-4, 2.87e-4, 1.45e-4}) == "asymptotic");  // orders 0.89 to 0.99
}

BOOST_AUTO_TEST_CASE(an_interval_that_holds_zero_is_not_asymptotic) {
  // The last two pairwise orders are 1, the first -2: the slope is 0.1 give or take 2, which is no order at
  // all.
  ObservedOrder const observed = observed_order(halving({1.0, 4.0, 2.0, 1.0}));
  BOOST_TEST(!observed.order.has_value());
  BOOST_TEST(!observed.lower.has_value());
  BOOST_TEST(observed.pairwise.size() == 3u);
  BOOST_TEST(observed.verdict == "pre-asymptotic");
}

BOOST_AUTO_TEST_CASE(errors_that_grow_are_diverging) {
  BOOST_TEST(verdict({1e-3, 2e-3, 4e-3, 8e-3}) == "diverging");
  BOOST_TEST(verdict({1e-3, 1e-3, 1e-3, 8e-3}) == "diverging");
  BOOST_TEST(*observed_order(halving({1e-3, 2e-3, 4e-3, 8e-3})).order == -1.0, tolerance(1e-4));
}

BOOST_AUTO_TEST_CASE(a_failed_finest_level_is_diverging_however_well_the_others_converge) {
  Levels levels = halving({1.0, 0.25, 0.0625, 0.015625});
  levels.back().errors.clear();
  ObservedOrder const observed = observed_order(levels);
  BOOST_TEST(observed.verdict == "diverging");
  BOOST_TEST(*observed.order == 2.0, tolerance(1e-4));
  for (LadderLevel& level : levels) level.errors.clear();
  BOOST_TEST(observed_order(levels).verdict == "diverging");
  BOOST_TEST(!observed_order(levels).order.has_value());
}

BOOST_AUTO_TEST_CASE(a_failed_level_in_between_is_stepped_over) {
  Levels levels = halving({1.0, 0.25, 0.0625, 0.015625, 0.00390625});
  levels[2].errors.clear();
  ObservedOrder const observed = observed_order(levels);
  BOOST_TEST(*observed.order == 2.0, tolerance(1e-4));
  BOOST_TEST(observed.pairwise.size() == 3u);
  for (Number const& p : observed.pairwise) BOOST_TEST(*p == 2.0, tolerance(1e-12));
  BOOST_TEST(observed.verdict == "asymptotic");
}

BOOST_AUTO_TEST_CASE(levels_at_round_off_are_left_out_and_the_ladder_is_floored) {
  Levels levels = halving({1e-4, 2.5e-5, 6.25e-6, 3e-15, 2e-15}, 1e-14);
  ObservedOrder const observed = observed_order(levels);
  BOOST_TEST(std::abs(*observed.order - 2.0) < 0.3);
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
  BOOST_TEST(*other.order == *one.order, tolerance(1e-6));
  BOOST_TEST(*other.lower == *one.lower, tolerance(1e-6));
  BOOST_TEST(other.verdict == one.verdict);
}

BOOST_AUTO_TEST_CASE(a_large_spread_of_seeds_widens_the_interval_of_a_lucky_straight_line) {
  Levels steady, scattered;
  for (double const spacing : {1.0, 0.5, 0.25, 0.125}) {
    steady.push_back({spacing, {0.99 * spacing, spacing, 1.01 * spacing}, 0.0});
    scattered.push_back({spacing, {0.6 * spacing, spacing, 1.4 * spacing}, 0.0});
  }
  ObservedOrder const one = observed_order(steady), other = observed_order(scattered);
  BOOST_TEST(*one.order == 1.0, tolerance(0.02));
  BOOST_TEST(*one.upper - *one.lower < 0.1);
  BOOST_TEST(one.verdict == "asymptotic");
  // Of the mean of three the scatter is 0.4 / sqrt(3), of the slope over four doublings that by 1.55: +-0.29
  // at 95%.
  BOOST_TEST(other.verdict == "pre-asymptotic");
  if (other.order) BOOST_TEST(*other.upper - *other.lower > 0.58);
}

BOOST_AUTO_TEST_CASE(a_level_with_seeds_counts_by_its_mean_error) {
  Levels levels = halving({4.0, 2.0, 1.0});
  levels[1].errors = {1.0, 2.0, 3.0};
  BOOST_TEST(*observed_order(levels).pairwise[0] == 1.0, tolerance(1e-12));
  BOOST_TEST(*observed_order(levels).pairwise[1] == 1.0, tolerance(1e-12));
}

// Ladders that somebody published or that stood in a study, with the verdict that an expert comes to.

BOOST_AUTO_TEST_CASE(a_first_order_scheme_with_a_next_term_has_an_interval_that_holds_1) {
  ObservedOrder const observed =
      observed_at(doublings(32, 5), {1.119646e-7, 6.187221e-8, 3.258335e-8, 1.672761e-8, 8.475962e-9});
  BOOST_TEST(observed.verdict == "asymptotic");
  BOOST_TEST((*observed.lower < 1.0 && *observed.upper > 1.0));
  BOOST_TEST(*observed.upper - *observed.lower < 0.1);
}

BOOST_AUTO_TEST_CASE(an_order_on_a_floor_is_told_with_its_floor) {
  ObservedOrder const observed = observed_at(
      doublings(128, 7),
      {5.029443e-9, 1.028798e-9, 1.842775e-10, 4.611129e-11, 1.256730e-11, 6.526699e-12, 5.722152e-12});
  BOOST_TEST(observed.verdict == "floored");
  BOOST_TEST(observed.model == "power on a floor");
  BOOST_TEST((*observed.lower < 2.26 && *observed.upper > 2.26));
  BOOST_TEST_REQUIRE(observed.floor.has_value());
  BOOST_TEST((observed.floor->lower < 5.7e-12 && observed.floor->upper > 5.7e-12));
  BOOST_TEST(resolution_for(observed, 1e-12, {128, 8192}).remark.starts_with("never"));
  BOOST_TEST(*resolution_for(observed, 1e-9, {128, 8192}).resolution == 256.0, tolerance(0.1));
}

BOOST_AUTO_TEST_CASE(a_plain_first_order_ladder_is_asymptotic) {
  ObservedOrder const observed =
      observed_at(doublings(10, 6), {0.195, 0.110, 0.0566, 0.0285, 0.0143, 0.00714});
  BOOST_TEST(observed.verdict == "asymptotic");
  BOOST_TEST((*observed.lower < 1.0 && *observed.upper > 1.0));
  // 0.00714 at N = 320 and order 1: 0.001 at 2285.
  BOOST_TEST(*resolution_for(observed, 1e-3, {10, 320}).resolution == 2285.0, tolerance(0.05));
  BOOST_TEST(resolution_for(observed, 1e-3, {10, 320}).remark == "beyond the levels that were run");
  BOOST_TEST(resolution_for(observed, 0.05, {10, 320}).remark.empty());
}

BOOST_AUTO_TEST_CASE(a_clean_floor_is_told_however_much_of_the_error_it_holds) {
  // A power of order 1 or 2 on a floor is also a floor of order 0 with a next term, which must not hide it.
  for (double const order : {1.0, 2.0}) {
    for (double const floor : {5.2e-3, 5.6e-3, 1e-2, 5e-2}) {  // a seventh of the finest error and more
      std::vector<double> errors;
      for (double const n : doublings(10, 6)) errors.push_back(floor + std::pow(10.0 / n, order));
      ObservedOrder const observed = observed_at(doublings(10, 6), errors);
      BOOST_TEST_REQUIRE(observed.floor.has_value(), "order " << order << ", floor " << floor);
      BOOST_TEST(observed.floor->value == floor, tolerance(0.02));
      BOOST_TEST(*observed.order == order, tolerance(0.02));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_ladder_that_stops_at_once_is_floored_and_has_no_order) {
  ObservedOrder const observed = observed_at(doublings(10, 5), {1.01e-5, 9.9e-7, 1.08e-6, 1.08e-6, 1.19e-6});
  BOOST_TEST(observed.verdict == "floored");
  BOOST_TEST(!observed.order.has_value());
  BOOST_TEST_REQUIRE(observed.floor.has_value());
  BOOST_TEST((observed.floor->lower < 1.08e-6 && observed.floor->upper > 1.08e-6));
}

BOOST_AUTO_TEST_CASE(three_levels_that_hardly_change_have_no_order) {
  ObservedOrder const observed = observed_at(doublings(10, 3), {0.326, 0.310, 0.296});
  BOOST_TEST(observed.verdict == "floored");
  BOOST_TEST(!observed.order.has_value());
  BOOST_TEST(!observed.lower.has_value());
}

BOOST_AUTO_TEST_CASE(pairwise_orders_that_wander_are_not_asymptotic) {
  // 0.46, 0.13, 0.30: jittered particles at fixed h/dx.
  BOOST_TEST(observed_at(doublings(25, 4), {1.0, 0.727, 0.664, 0.540}).verdict != "asymptotic");
}

BOOST_AUTO_TEST_CASE(a_good_ladder_of_order_1_5_is_asymptotic) {
  ObservedOrder const observed = observed_at(doublings(25, 4), {3.70e-3, 1.33e-3, 4.65e-4, 1.62e-4});
  BOOST_TEST(observed.verdict == "asymptotic");
  BOOST_TEST((*observed.lower < 1.5 && *observed.upper > 1.5));
}

BOOST_AUTO_TEST_CASE(three_levels_are_never_asymptotic) {
  BOOST_TEST(verdict({1.0, 0.25, 0.0625}) == "pre-asymptotic");
  BOOST_TEST(verdict({1.0, 0.5, 0.25}) == "pre-asymptotic");
}

BOOST_AUTO_TEST_CASE(a_signed_error_that_passes_through_zero_is_seen_and_said) {
  std::vector<double> const errors{5.1e-3, 6.6e-4, 1.5e-4}, means{-5.1e-3, -6.6e-4, 1.5e-4};
  Levels levels = halving(errors);
  for (std::size_t k = 0; k < levels.size(); ++k) levels[k].mean = means[k];
  ObservedOrder const observed = observed_order(levels);
  BOOST_TEST(observed.verdict == "pre-asymptotic");
  BOOST_TEST(!observed.order.has_value());
  BOOST_TEST(observed.reason.find("passes through zero between levels 2 and 3") != std::string::npos);
  // Levels after the crossing count: here they are of order 1.
  for (double const e : {1.2e-4, 6.1e-5, 3.05e-5, 1.526e-5})
    levels.push_back({levels.back().spacing * 0.5, {e}, 0.0, false, e});
  levels[2].mean = -1.5e-4;  // now between levels 3 and 4
  ObservedOrder const later = observed_order(levels);
  BOOST_TEST(later.verdict == "asymptotic");
  BOOST_TEST((*later.lower < 1.0 && *later.upper > 1.0));
  BOOST_TEST(later.reason.find("between levels 3 and 4") != std::string::npos);
  // An error that swings about zero again and again keeps its levels.
  Levels swinging = halving({1.0, 0.35, 0.123, 0.043, 0.0151, 0.0053});
  double sign = 0.8;
  for (LadderLevel& level : swinging) level.mean = (sign = -sign) * level.errors[0];
  ObservedOrder const swings = observed_order(swinging);
  BOOST_TEST(swings.verdict == "asymptotic");
  BOOST_TEST((*swings.lower < 1.51 && *swings.upper > 1.51));
  BOOST_TEST(swings.reason.find("changes its sign 5 times") != std::string::npos);
  // A mean that is a small part of the error says nothing.
  for (LadderLevel& level : levels) *level.mean *= 0.1;
  BOOST_TEST(observed_order(levels).reason.find("zero") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(alternating_levels_do_not_diverge_and_six_of_them_tell_the_order) {
  std::vector<double> errors{1.13e-5, 2.55e-4, 4.12e-6, 6.49e-5};
  ObservedOrder const four = observed_at(doublings(25, 4), errors);
  BOOST_TEST(four.verdict == "pre-asymptotic");
  BOOST_TEST(four.reason.find("up and down") != std::string::npos);
  BOOST_TEST(!four.order.has_value());
  errors.insert(errors.end(), {1.07e-6, 1.59e-5});
  ObservedOrder const six = observed_at(doublings(25, 6), errors);
  BOOST_TEST(six.model == "alternating power");
  BOOST_TEST(six.verdict != "diverging");
  errors.insert(errors.end(), {2.69e-7, 3.97e-6});
  ObservedOrder const eight = observed_at(doublings(25, 8), errors);
  BOOST_TEST(eight.verdict == "asymptotic");
  BOOST_TEST(
      (*eight.lower < 1.0 && *eight.upper > 1.0));  // every other level falls fourfold over two doublings
}

BOOST_AUTO_TEST_CASE(an_order_above_what_the_solution_allows_will_not_last) {
  Levels const levels = halving({1.0, 0.25, 0.0625, 0.015625});
  BOOST_TEST(observed_order(levels, {2.0, std::nullopt}).verdict == "asymptotic");
  ObservedOrder const observed = observed_order(levels, {0.5, std::nullopt});
  BOOST_TEST(observed.verdict == "pre-asymptotic");
  BOOST_TEST(observed.reason.find("faster than the solution allows") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(errors_in_time_of_a_tenth_or_more_are_said) {
  Levels const levels = halving({1.0, 0.5, 0.25, 0.125});
  BOOST_TEST(observed_order(levels, {std::nullopt, 0.3}).reason.find("errors in time may be 30% of these") !=
             std::string::npos);
  BOOST_TEST(observed_order(levels, {std::nullopt, 0.01}).reason.find("time") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(the_resolution_for_an_error_follows_the_fitted_law) {
  ObservedOrder observed;
  observed.verdict = "asymptotic";
  observed.order = 2.0;
  observed.law = ErrorLaw{0.0, 0.01, 2.0, 0.0, 1.0};
  BOOST_TEST(*resolution_for(observed, 0.0025, {25, 100}).resolution == 200.0, tolerance(1e-9));
  BOOST_TEST(*resolution_for(observed, 0.04, {25, 100}).resolution == 50.0, tolerance(1e-9));
  BOOST_TEST(*resolution_for(observed, 0.5, {25, 100}).resolution == 25.0, tolerance(1e-9));
  BOOST_TEST(resolution_for(observed, 0.5, {25, 100}).remark == "the coarsest level has it");
  observed.law->floor = 0.002;
  BOOST_TEST(*resolution_for(observed, 0.0045, {25, 100}).resolution == 200.0, tolerance(1e-9));
  BOOST_TEST(!resolution_for(observed, 0.001, {25, 100}).resolution.has_value());
  observed.order.reset();  // a law whose order nobody knows promises nothing
  BOOST_TEST(resolution_for(observed, 0.0045, {25, 100}).remark == "not known");
  observed.order = 2.0;
  observed.law.reset();
  BOOST_TEST(resolution_for(observed, 0.001, {25, 100}).remark == "not known");
}

BOOST_AUTO_TEST_CASE(the_rules_that_describe_prints_name_every_verdict) {
  for (char const* word : {"asymptotic", "pre-asymptotic", "floored", "diverging", "not-refined"})
    BOOST_TEST(verdict_rules.find(word) != std::string_view::npos);
}

BOOST_AUTO_TEST_SUITE_END()
