// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/pending_runs.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "reports/json/results_json.hpp"
#include "tests/support/documents.hpp"
#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_study_pending_runs)

using namespace sphverify;
using namespace sphverify::tests;

Json const study{{"name", "one"}};

/// Two forms at two resolutions, in the order of a study: the forms outside.
std::vector<RunSpec> const& four_runs() {
  static std::vector<RunSpec> const runs = [] {
    std::vector<RunSpec> all;
    for (char const* form : {"conduction/brookshaw", "conduction/lucy-flux"}) {
      for (int const resolution : {8, 12}) {
        RunChoice choice;
        choice.formulation = form;
        choice.resolution = resolution;
        all.push_back(make_spec(choice));
      }
    }
    return all;
  }();
  return runs;
}

RunOptions timed(int most) {
  RunOptions options;
  options.measure = {Measure::error, Measure::cost, Measure::stability};
  options.repeat = {.most = most, .least = most, .spread = 0.0, .seconds = 0.0};
  return options;
}

using Found = std::map<std::size_t, PendingRuns::Finished>;

/// Carries all of them out, and says what was finished after each.
Found carry_out(PendingRuns& pending, std::vector<std::size_t> const& order,
                std::vector<std::size_t>& counts) {
  for (std::size_t const k : order) pending.add(k);
  Found all;
  for (std::size_t const k : order) {
    all.merge(pending.carry_out(k));
    counts.push_back(all.size());
  }
  return all;
}

BOOST_AUTO_TEST_CASE(runs_of_one_group_wait_for_each_other_and_are_timed_together) {
  RunOptions const options = timed(3);
  PendingRuns pending(four_runs(), options, nullptr);
  std::vector<std::size_t> order{0, 1, 2, 3};
  pending.sort(order);
  BOOST_TEST((order == std::vector<std::size_t>{0, 2, 1, 3}), "those of a resolution stand together");
  std::vector<std::size_t> counts;
  Found const found = carry_out(pending, order, counts);
  BOOST_TEST((counts == std::vector<std::size_t>{0, 2, 2, 4}));
  for (auto const& [index, run] : found) {
    BOOST_TEST(run.record.status == "ok", run.record.reason);
    BOOST_TEST(run.record.label == four_runs()[index].label);
    BOOST_TEST(run.record.stability.has_value());
    BOOST_TEST_REQUIRE(run.record.cost.has_value());
    BOOST_TEST(run.record.cost->repeats == 3);
    BOOST_TEST(run.record.cost->warm_up);
    BOOST_TEST(run.record.cost->round_seconds.size() == 3u);
    BOOST_TEST(run.repeat_seconds > 0.0);
  }
  auto const occasion = [&](std::size_t k) { return found.at(k).record.cost->occasion; };
  BOOST_TEST(!occasion(0).empty());
  BOOST_TEST(occasion(0) == occasion(2));
  BOOST_TEST(occasion(1) == occasion(3));
  BOOST_TEST(occasion(0) != occasion(1));
}

BOOST_AUTO_TEST_CASE(runs_that_are_timed_once_or_not_at_all_wait_for_no_one) {
  for (RunOptions options : {timed(1), RunOptions{}}) {
    PendingRuns pending(four_runs(), options, nullptr);
    std::vector<std::size_t> counts;
    Found const found = carry_out(pending, {0, 1, 2, 3}, counts);
    BOOST_TEST((counts == std::vector<std::size_t>{1, 2, 3, 4}));
    BOOST_TEST(found.at(0).record.cost.has_value() == options.measure.contains(Measure::cost));
    if (found.at(0).record.cost) BOOST_TEST(found.at(0).record.cost->occasion.empty());
  }
}

BOOST_AUTO_TEST_CASE(a_run_that_fails_keeps_no_one_waiting) {
  std::vector<RunSpec> runs{four_runs()[0], four_runs()[2], four_runs()[2]};
  runs[1].discretisation.layout = runs[0].discretisation.layout;
  runs[1].resolution = runs[0].resolution;
  runs[1].smoothing_ratio = 1e6;  // refused, whatever for
  RunOptions const options = timed(2);
  PendingRuns pending(runs, options, nullptr);
  std::vector<std::size_t> counts;
  Found const found = carry_out(pending, {0, 1, 2}, counts);
  BOOST_TEST(found.size() == 3u);
  BOOST_TEST(found.at(0).record.cost->repeats == 2);
}

BOOST_AUTO_TEST_CASE(what_was_measured_but_not_timed_is_taken_up_from_the_journal) {
  TemporaryFolder const folder;
  std::string const path = folder.file("j");
  RunOptions const options = timed(2);
  {
    Journal journal(path, study, false);
    PendingRuns pending(four_runs(), options, &journal);
    for (std::size_t const k : {0, 2, 1, 3}) pending.add(k);
    BOOST_TEST(pending.carry_out(0).empty());
    BOOST_TEST(pending.carry_out(2).size() == 2u);
    BOOST_TEST(pending.carry_out(1).empty());  // and is killed here
  }
  Journal journal(path, study, true);
  BOOST_TEST(journal.finished().size() == 2u);
  BOOST_TEST(journal.finished().at(0).cost->repeats == 2);
  BOOST_TEST(journal.finished().at(0).cost->occasion == journal.finished().at(2).cost->occasion);
  BOOST_TEST_REQUIRE(journal.awaiting().size() == 1u);
  BOOST_TEST(!journal.awaiting().at(1).record.cost.has_value());
  std::string const before = text_of(path);
  PendingRuns pending(four_runs(), options, &journal);
  for (std::size_t const k : {1, 3}) pending.add(k);
  BOOST_TEST(pending.carry_out(1).empty());
  BOOST_TEST(text_of(path) == before, "it is not measured again");
  Found const found = pending.carry_out(3);
  BOOST_TEST(found.size() == 2u);
  BOOST_TEST(found.at(1).record.cost->occasion == found.at(3).record.cost->occasion);
  Journal const whole(path + ".none", study, true);
  BOOST_TEST(whole.finished().empty());
}

BOOST_AUTO_TEST_CASE(a_time_budget_ends_repeats_but_never_before_the_first) {
  RunOptions options = timed(1000000);
  options.repeat.most = 1000;
  options.time_budget = 0.4;
  PendingRuns pending(four_runs(), options, nullptr);
  std::vector<std::size_t> counts;
  Found const found = carry_out(pending, {0, 2}, counts);
  for (auto const& [index, run] : found) {
    BOOST_TEST(run.record.status == "ok", run.record.reason);
    BOOST_TEST(run.record.cost->repeats >= 1);
  }
}

BOOST_AUTO_TEST_CASE(an_interrupt_is_heeded_between_repeats) {
  std::atomic<bool> interrupted{false};
  RunOptions options = timed(1000);
  options.interrupted = &interrupted;
  MeasuredRun const run = measure_run(four_runs()[0], options);
  BOOST_TEST(run.awaits_timing);
  Repeats repeats = repeats_of(four_runs()[0], options, run);
  repeats.repeat();
  interrupted = true;
  BOOST_CHECK_THROW(repeats.repeat(), Interrupted);
}

BOOST_AUTO_TEST_SUITE_END()
