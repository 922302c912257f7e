// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/timing.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numeric>
#include <random>

BOOST_AUTO_TEST_SUITE(harness_measure_timing)

using namespace sphverify;
using boost::test_tools::tolerance;

/// A run whose repeats take the times given, one after the other and over again; no clock is read.
struct FakeRun {
  std::vector<double> times;
  double cpu_share = 1.0;
  int batch = 1;
  int carried_out = 0;

  std::optional<Cost> operator()() {
    Cost cost;
    cost.seconds = times[static_cast<std::size_t>(carried_out++) % times.size()];
    cost.cpu_seconds = cpu_share * cost.seconds;
    cost.steps = static_cast<std::uint64_t>(carried_out);
    cost.rate_evaluations = 1;
    cost.batch = batch;
    return cost;
  }
};

std::optional<Cost> timed(RepeatRule const& rule, FakeRun& run) {
  return time_repeats(rule, std::ref(run), [] { return false; });
}

std::vector<double> const steady{1.000, 1.001, 0.999, 1.002};
std::vector<double> const noisy{1.0, 1.5, 0.9, 1.2, 2.0};

/// P(at most k heads of n) by counting, in whole numbers.
double at_most(std::size_t k, std::size_t n) {
  double sum = 0.0;
  double ways = 1.0;
  for (std::size_t j = 0; j <= std::min(k, n); ++j) {
    sum += ways;
    ways = ways * static_cast<double>(n - j) / static_cast<double>(j + 1);
  }
  return std::ldexp(sum, -static_cast<int>(n));
}

BOOST_AUTO_TEST_CASE(ranks_are_the_innermost_that_leave_95_percent_between_them) {
  for (std::size_t n = 1; n <= 45; ++n) {
    std::size_t const rank = median_rank(n);
    if (rank > 0) BOOST_TEST(2.0 * at_most(rank - 1, n) <= 0.05, n);
    BOOST_TEST(2.0 * at_most(rank, n) > 0.05, n);
  }
  BOOST_TEST(median_rank(0) == 0u);
  BOOST_TEST(median_rank(5) == 0u);
  BOOST_TEST(median_rank(6) == 1u);
  BOOST_TEST(median_rank(25) == 8u);
  BOOST_TEST(median_rank(1000) == 469u);  // P(at most 468 heads) = 0.0231, of 469 0.0268
}

BOOST_AUTO_TEST_CASE(a_median_comes_with_an_interval_from_six_on) {
  BOOST_TEST(!median_of({}).median.has_value());
  BOOST_TEST(*median_of({3.0, 1.0}).median == 2.0);
  MedianSeconds const five = median_of({5.0, 1.0, 4.0, 2.0, 3.0});
  BOOST_TEST(*five.median == 3.0);
  BOOST_TEST((!five.low && !five.high));
  MedianSeconds const six = median_of({6.0, 1.0, 5.0, 2.0, 4.0, 3.0});
  BOOST_TEST(*six.median == 3.5);
  BOOST_TEST(*six.low == 1.0);
  BOOST_TEST(*six.high == 6.0);
  std::vector<double> many(25);
  std::iota(many.rbegin(), many.rend(), 1.0);
  BOOST_TEST(*median_of(many).low == 8.0);
  BOOST_TEST(*median_of(many).high == 18.0);
}

BOOST_AUTO_TEST_CASE(a_number_of_repeats_is_kept_to) {
  for (int const count : {1, 3, 30}) {
    FakeRun run{steady};
    auto const cost = timed({.most = count, .least = count, .spread = 0.0, .seconds = 0.0}, run);
    BOOST_TEST(run.carried_out == count);
    BOOST_TEST(cost->repeats == count);
  }
}

BOOST_AUTO_TEST_CASE(a_steady_clock_is_believed_early_and_a_noisy_one_late) {
  RepeatRule const rule{.most = 40, .least = 6, .spread = 0.02, .seconds = 0.0};
  FakeRun calm{steady};
  BOOST_TEST(timed(rule, calm)->repeats == 6);
  FakeRun wild{noisy};
  BOOST_TEST(timed(rule, wild)->repeats == 40);
  // In between: a third of the repeats is slow, and spoils the interval until enough of the others are in.
  FakeRun mixed{{1.0, 1.001, 3.0}};
  auto const cost = timed(rule, mixed);
  BOOST_TEST(cost->repeats > 6);
  BOOST_TEST(cost->repeats < 40);
  BOOST_TEST(*cost->median.high - *cost->median.low < 0.02 * *cost->median.median);
}

BOOST_AUTO_TEST_CASE(the_spread_is_not_looked_at_before_the_least_number_of_repeats) {
  FakeRun run{{1.0}};
  BOOST_TEST(timed({.most = 40, .least = 9, .spread = 0.02, .seconds = 0.0}, run)->repeats == 9);
  // Fewer than six have no interval that could be narrow.
  FakeRun few{{1.0}};
  BOOST_TEST(timed({.most = 40, .least = 2, .spread = 0.02, .seconds = 0.0}, few)->repeats == 6);
}

BOOST_AUTO_TEST_CASE(time_that_is_spent_ends_the_repeats_but_one_there_always_is) {
  FakeRun run{{1.0}};
  BOOST_TEST(timed({.most = 40, .least = 20, .spread = 0.02, .seconds = 2.5}, run)->repeats == 3);
  FakeRun slow{{10.0}};
  BOOST_TEST(timed({.most = 40, .least = 20, .spread = 0.02, .seconds = 2.5}, slow)->repeats == 1);
  FakeRun in_batches{{0.01}, 1.0, 100};
  BOOST_TEST(timed({.most = 40, .least = 20, .spread = 0.02, .seconds = 2.5}, in_batches)->repeats == 3);
  FakeRun late{{1.0}};
  auto const cost = time_repeats({.most = 5, .least = 5, .spread = 0.0, .seconds = 0.0}, std::ref(late),
                                 [&] { return late.carried_out >= 2; });
  BOOST_TEST(cost->repeats == 2);
}

BOOST_AUTO_TEST_CASE(the_fastest_repeat_is_kept_with_the_median_of_all) {
  FakeRun run{noisy, 0.8};
  auto const cost = timed({.most = 5, .least = 5, .spread = 0.0, .seconds = 0.0}, run);
  BOOST_TEST(cost->seconds == 0.9);
  BOOST_TEST(cost->steps == 3u, "of the same repeat");
  BOOST_TEST(*cost->cpu_seconds == 0.8 * 0.9);
  BOOST_TEST(*cost->median.median == 1.2);
  BOOST_TEST(!cost->median.low.has_value());
  BOOST_TEST(*cost->busy == 0.8, tolerance(1e-14));
  BOOST_TEST(cost->warm_up);
}

BOOST_AUTO_TEST_CASE(busy_is_of_all_repeats_and_missing_with_several_threads) {
  int call = 0;
  bool is_ours = true;
  auto const disturbed = [&]() -> std::optional<Cost> {
    Cost cost;
    cost.seconds = ++call == 1 ? 1.0 : 3.0;  // the second waited for the processor for two seconds
    cost.cpu_seconds = 1.0;
    cost.rate_evaluations = is_ours ? 1 : 0;
    return cost;
  };
  RepeatRule const twice{.most = 2, .least = 2, .spread = 0.0, .seconds = 0.0};
  BOOST_TEST(*time_repeats(twice, disturbed, [] { return false; })->busy == 0.5);
  // A code that is not ours, whose rates nobody counted, may wait for what it likes.
  is_ours = false;
  BOOST_TEST(!time_repeats(twice, disturbed, [] { return false; })->busy.has_value());
  auto const threaded = [&]() -> std::optional<Cost> {
    Cost cost;
    cost.seconds = 1.0;
    return cost;
  };
  BOOST_TEST(!time_repeats(twice, threaded, [] { return false; })->busy.has_value());
}

BOOST_AUTO_TEST_CASE(a_repeat_that_breaks_ends_them_and_the_first_leaves_nothing) {
  FakeRun run{steady};
  auto const breaking = [&](int at) {
    return time_repeats(
        {.most = 5, .least = 5, .spread = 0.0, .seconds = 0.0},
        [&]() -> std::optional<Cost> {
          auto const cost = run();
          return run.carried_out == at ? std::nullopt : cost;
        },
        [] { return false; });
  };
  BOOST_TEST(breaking(3)->repeats == 2);
  run.carried_out = 0;
  BOOST_TEST(!breaking(1).has_value());
}

RepeatRule const up_to_ten{.most = 10, .least = 2, .spread = 0.02, .seconds = 0.0};

/// Runs whose repeats write down who was carried out, and when.
struct Turns {
  std::string order;
  std::vector<Repeats> runs;

  void add(char name, RepeatRule const& rule, std::vector<double> times, int breaks_at = 0) {
    runs.emplace_back(
        rule,
        [this, name, breaks_at, run = FakeRun{std::move(times)}]() mutable -> std::optional<Cost> {
          order += name;
          auto const cost = run();
          return run.carried_out == breaks_at ? std::nullopt : cost;
        },
        [] { return false; });
  }
};

BOOST_AUTO_TEST_CASE(runs_take_turns_and_every_other_round_goes_back) {
  Turns turns;
  RepeatRule const three{.most = 3, .least = 3, .spread = 0.0, .seconds = 0.0};
  for (char const name : {'a', 'b', 'c'}) turns.add(name, three, {1.0 + name, 2.0 + name, 3.0 + name});
  auto const costs = take_turns(turns.runs, "here");
  BOOST_TEST(turns.order == "abccbaabc");
  BOOST_TEST_REQUIRE(costs.size() == 3u);
  BOOST_TEST(costs[1]->occasion == "here");
  BOOST_TEST((costs[1]->round_seconds == std::vector<double>{1.0 + 'b', 2.0 + 'b', 3.0 + 'b'}));
  BOOST_TEST(costs[1]->repeats == 3);
  BOOST_TEST(costs[1]->seconds == 1.0 + 'b');
  BOOST_TEST(*costs[1]->median.median == 2.0 + 'b');
}

BOOST_AUTO_TEST_CASE(rounds_go_on_until_all_are_narrow_and_a_run_that_may_go_no_further_drops_out) {
  Turns turns;
  turns.add('s', {.most = 50, .least = 6, .spread = 0.02, .seconds = 0.0}, steady);
  turns.add('n', {.most = 20, .least = 6, .spread = 0.02, .seconds = 0.0}, noisy);
  auto costs = take_turns(turns.runs, "x");
  BOOST_TEST(costs[0]->repeats == 20, "the steady one stays for the noisy one");
  BOOST_TEST(costs[1]->repeats == 20);

  Turns spent;
  spent.add('l', {.most = 50, .least = 2, .spread = 0.0, .seconds = 2.5}, {1.0});
  spent.add('s', {.most = 5, .least = 2, .spread = 0.0, .seconds = 0.0}, {0.1});
  costs = take_turns(spent.runs, "x");
  BOOST_TEST(spent.order == "lssllsss", "the long one has had its time after three");
  BOOST_TEST(costs[0]->repeats == 3);
  BOOST_TEST(costs[1]->round_seconds.size() == 5u);

  Turns broken;
  broken.add('a', up_to_ten, {1.0}, 1);
  broken.add('b', {.most = 3, .least = 3, .spread = 0.0, .seconds = 0.0}, {1.0}, 3);
  costs = take_turns(broken.runs, "x");
  BOOST_TEST(!costs[0].has_value());
  BOOST_TEST(costs[1]->repeats == 2);
  BOOST_TEST(costs[1]->round_seconds.size() == 2u);
}

BOOST_AUTO_TEST_CASE(a_ratio_of_runs_that_took_turns_is_taken_round_by_round) {
  auto const in_rounds = [](std::vector<double> seconds, std::string const& occasion = "x") {
    Cost cost;
    cost.occasion = occasion;
    cost.round_seconds = std::move(seconds);
    return cost;
  };
  MedianSeconds const ratio = median_ratio(in_rounds({2, 4, 6, 8, 10, 12, 7}), in_rounds({1, 2, 3, 4, 5, 5}));
  BOOST_TEST(*ratio.median == 2.0);
  BOOST_TEST(*ratio.low == 2.0);
  BOOST_TEST(*ratio.high == 2.4, "the seventh round of one has no other");
  MedianSeconds const five = median_ratio(in_rounds({2, 4, 6, 8, 10}), in_rounds({1, 2, 3, 4, 5}));
  BOOST_TEST(*five.median == 2.0);
  BOOST_TEST(!five.low.has_value());
  BOOST_TEST(!median_ratio(in_rounds({1, 2}), in_rounds({1, 2}, "y")).median.has_value());
  BOOST_TEST(!median_ratio(in_rounds({1, 2}, ""), in_rounds({1, 2}, "")).median.has_value(), "timed alone");
  BOOST_TEST(!median_ratio(in_rounds({1, 2}), in_rounds({1, 0})).median.has_value());
}

/// A machine on which other work comes and goes: while it is there everything takes 1.6 times as long; beside
/// that every repeat is late by a random amount. Time passes as runs are carried out.
struct BusyMachine {
  std::mt19937& draw;
  double until = 0.0, now = 0.0;
  bool busy = false;

  double uniform() { return (static_cast<double>(draw()) + 0.5) / 4294967296.0; }
  double take(double work) {
    while (now >= until) {
      busy = !busy;
      until += -10.0 * std::log(uniform());  // as long as ten runs, on average
    }
    double const seconds = work * (busy ? 1.6 : 1.0) * (1.0 - 0.02 * std::log(uniform()));
    now += seconds;
    return seconds;
  }
};

/// Of so many pairs, how many whose interval leaves 1 out, by three ways of timing them.
struct Alarms {
  int alone = 0, turns = 0, rounds = 0;
};

Alarms alarms(double work, int pairs, std::uint32_t seed) {
  RepeatRule const rule{.most = 25, .least = 6, .spread = 0.02, .seconds = 0.0};
  std::mt19937 draw(seed);
  auto const apart = [](double low, double high) { return low > 1.0 || high < 1.0; };
  auto const crosswise = [&](Cost const& a, Cost const& b) {
    return apart(*a.median.low / *b.median.high, *a.median.high / *b.median.low);
  };
  Alarms found;
  for (int n = 0; n < pairs; ++n) {
    BusyMachine machine{draw};
    auto const repeats = [&](double of) {
      return Repeats(
          rule,
          [&machine, of]() -> std::optional<Cost> {
            Cost cost;
            cost.seconds = machine.take(of);
            return cost;
          },
          [] { return false; });
    };
    auto const alone = [&](double of) {
      Repeats one = repeats(of);
      while (!one.is_over() && !one.is_narrow()) one.repeat();
      return *one.cost();
    };
    Cost const first = alone(work);
    found.alone += crosswise(first, alone(1.0));
    std::vector<Repeats> both{repeats(work), repeats(1.0)};
    auto const costs = take_turns(both, "x");
    found.turns += crosswise(*costs[0], *costs[1]);
    MedianSeconds const ratio = median_ratio(*costs[0], *costs[1]);
    found.rounds += apart(*ratio.low, *ratio.high);
  }
  return found;
}

BOOST_AUTO_TEST_CASE(a_machine_that_changes_does_not_tell_equal_runs_apart_and_unequal_ones_are) {
  constexpr int pairs = 2000;
  Alarms const equal = alarms(1.0, pairs, 11);
  BOOST_TEST_MESSAGE("equal runs told apart: alone " << equal.alone << ", in turn " << equal.turns
                                                     << ", round by round " << equal.rounds << " of "
                                                     << pairs);
  BOOST_TEST(equal.alone > pairs / 10, "or this machine would not try what it is to try");
  BOOST_TEST(equal.turns <= pairs / 20);
  BOOST_TEST(equal.rounds <= pairs / 20);
  for (double const work : {1.1, 1.3}) {
    Alarms const more = alarms(work, pairs, 12);
    BOOST_TEST_MESSAGE(work << " times the work found: alone " << more.alone << ", in turn " << more.turns
                            << ", round by round " << more.rounds << " of " << pairs);
    BOOST_TEST(more.rounds >= pairs * 9 / 10, work);
    BOOST_TEST(more.rounds > more.turns, work);
  }
}

BOOST_AUTO_TEST_CASE(a_batch_lasts_a_millisecond) {
  std::vector<int> tried;
  auto const each = [&](double seconds) {
    tried.clear();
    return batch_for([&, seconds](int batch) {
      tried.push_back(batch);
      return seconds * batch;
    });
  };
  BOOST_TEST(each(1.0) == 1);
  BOOST_TEST(tried.size() == 1u);
  BOOST_TEST(each(0.9e-3) == 2);
  BOOST_TEST(each(1e-6) == 1024);
  BOOST_TEST(tried.size() == 11u);
  BOOST_TEST(each(0.0) == 1 << 20, "a clock that stands still");
}

BOOST_AUTO_TEST_CASE(stopping_when_the_interval_is_narrow_does_not_make_it_miss_the_median) {
  // Times as on a machine with other work: never faster than one, slower by a random amount.
  std::mt19937 draw(7);
  for (double const noise : {0.01, 0.03, 0.1}) {
    int held = 0;
    constexpr int trials = 1000;
    for (int t = 0; t < trials; ++t) {
      auto const once = [&]() -> std::optional<Cost> {
        Cost cost;
        cost.seconds = 1.0 - noise * std::log((static_cast<double>(draw()) + 0.5) / 4294967296.0);
        return cost;
      };
      auto const cost =
          time_repeats({.most = 25, .least = 6, .spread = 0.02, .seconds = 0.0}, once, [] { return false; });
      double const median = 1.0 + noise * std::log(2.0);
      held += *cost->median.low <= median && median <= *cost->median.high;
    }
    BOOST_TEST_MESSAGE("noise " << noise << ": held in " << held << " of " << trials);
    BOOST_TEST(held >= 0.9 * trials, noise);
  }
}

BOOST_AUTO_TEST_SUITE_END()
