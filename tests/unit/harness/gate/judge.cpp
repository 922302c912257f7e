// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/gate/judge.hpp"

#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <limits>

#include "reports/json/results_json.hpp"
#include "tests/unit/harness/gate/small_results.hpp"

BOOST_AUTO_TEST_SUITE(harness_gate_judge)

using namespace sphverify;
using namespace sphverify::tests;

GateVerdict judged(std::string const& gate, Results const& results, Baselines const& baselines = {}) {
  return judge(gates_of(gate), results, baselines).at(0);
}

std::string outcome(std::string const& gate, Results const& results) {
  return std::string(word(judged(gate, results).verdict));
}

/// l2 errors 16e-4, 4e-4, 1e-4 at N = 25, 50, 100.
Results const& smooth() {
  static Results const results = results_of(second_order());
  return results;
}

BOOST_AUTO_TEST_CASE(limits_pass_and_fail_and_take_their_ends) {
  std::string const error = R"("measure": "error", )";
  for (auto const& [limit, expected] : {std::pair{R"("maximum": 2e-4)", "passed"},
                                        {R"("maximum": 1e-4)", "passed"},
                                        {R"("maximum": 9e-5)", "failed"},
                                        {R"("minimum": 1e-4)", "passed"},
                                        {R"("minimum": 2e-4)", "failed"},
                                        {R"("minimum": 5e-5, "maximum": 2e-4)", "passed"},
                                        {R"("minimum": 2e-4, "maximum": 3e-4)", "failed"},
                                        {R"("equals": 1e-4)", "passed"},
                                        {R"("equals": 2e-4)", "failed"}}) {
    BOOST_TEST(outcome(error + limit, smooth()) == expected, limit);
  }
}

BOOST_AUTO_TEST_CASE(a_gate_must_hold_for_all_that_it_selects_and_shows_the_worst) {
  GateVerdict const upper = judged(R"("measure": "error", "maximum": 1e-3, "resolution": "all")", smooth());
  BOOST_TEST((upper.verdict == Verdict::failed));
  BOOST_TEST(upper.looked_at == 3u);
  BOOST_TEST(upper.failing == 1u);
  BOOST_TEST(upper.measured == "l2 error 0.0016 K");
  BOOST_TEST(upper.limit == "<= 0.001");
  BOOST_TEST(says(upper.where, "N = 25"), upper.where);
  GateVerdict const lower = judged(R"("measure": "error", "minimum": 1e-9, "resolution": "all")", smooth());
  BOOST_TEST((lower.verdict == Verdict::passed));
  BOOST_TEST(says(lower.where, "N = 100"), lower.where);
}

BOOST_AUTO_TEST_CASE(a_run_that_failed_fails_every_gate_on_its_numbers) {
  Results const results = results_of({run_at(25, 1e-9), failed_at(50)});
  for (char const* gate : {R"("measure": "error", "maximum": 1)", R"("measure": "order", "minimum": -9)",
                           R"("measure": "order", "minimum": -9, "interval": "ignore")"}) {
    GateVerdict const verdict = judged(gate, results);
    BOOST_TEST((verdict.verdict == Verdict::failed), gate);
    BOOST_TEST(says(verdict.detail, "unstable: the temperature ran away"), verdict.detail);
    BOOST_TEST(says(verdict.measured, "unknown"), verdict.measured);
  }
}

BOOST_AUTO_TEST_CASE(a_status_must_be_the_one_named) {
  Results const results = results_of({run_at(25, 1.0), failed_at(50)});
  GateVerdict const verdict = judged(R"("measure": "status", "equals": "ok")", results);
  BOOST_TEST((verdict.verdict == Verdict::failed));
  BOOST_TEST(verdict.measured == "status unstable");
  BOOST_TEST(verdict.limit == "= ok");
  BOOST_TEST(verdict.detail == "the temperature ran away");
  BOOST_TEST(outcome(R"("measure": "status", "equals": "unstable", "resolution": 50)", results) == "passed");
  BOOST_TEST(outcome(R"("measure": "status", "equals": "ok", "resolution": 25)", results) == "passed");
}

BOOST_AUTO_TEST_CASE(a_limit_inside_the_interval_of_an_order_is_undecided) {
  Results const results = results_of(scattered());
  ObservedOrder const& l2 = results.series[0].orders[1].observed;
  BOOST_TEST_REQUIRE(results.series[0].orders[1].norm == "l2");
  double const inside = 0.5 * (*l2.lower + *l2.order);
  auto const gate = [&](double minimum, std::string const& rest) {
    return outcome(fmt::format(R"("measure": "order", "minimum": {}{})", minimum, rest), results);
  };
  BOOST_TEST(gate(inside, "") == "undecided");
  BOOST_TEST(gate(inside, R"(, "interval": "ignore")") == "passed");
  BOOST_TEST(gate(*l2.lower - 0.01, "") == "passed");
  BOOST_TEST(gate(0.5 * (*l2.upper + *l2.order), "") == "undecided", "the order itself is below");
  BOOST_TEST(gate(0.5 * (*l2.upper + *l2.order), R"(, "interval": "ignore")") == "failed");
  BOOST_TEST(gate(*l2.upper + 0.01, "") == "failed");
  BOOST_TEST(!holds(Verdict::undecided));
}

// brookshaw takes 2 [1.5, 3] times as long as lucy-flux, which takes a second for sure.
Results twice_as_long() {
  return results_of({timed_within(run_at(25, 1.0), 1.5, 2.0, 3.0),
                     timed_within(run_at(25, 1.0, "conduction/lucy-flux"), 1.0, 1.0, 1.0)});
}

std::string const ratio = R"("measure": "cost", "quantity": "median_seconds", "relative_to":
                             "conduction/lucy-flux", )";

BOOST_AUTO_TEST_CASE(a_ratio_of_timings_fails_only_if_all_of_its_interval_does) {
  Results const results = twice_as_long();
  for (auto const& [limit, expected] : {std::pair{R"("maximum": 3)", "passed"},
                                        {R"("maximum": 2.5)", "within-noise"},
                                        {R"("maximum": 1.6)", "within-noise"},
                                        {R"("maximum": 1.4)", "failed"},
                                        {R"("minimum": 1.5)", "passed"},
                                        {R"("minimum": 1.9)", "within-noise"},
                                        {R"("minimum": 3.1)", "failed"},
                                        {R"("minimum": 1.9, "maximum": 2.1)", "within-noise"},
                                        {R"("maximum": 2.5, "interval": "ignore")", "passed"},
                                        {R"("maximum": 1.6, "interval": "ignore")", "failed"}}) {
    BOOST_TEST(outcome(ratio + limit, results) == expected, limit);
  }
  GateVerdict const noise = judged(ratio + R"("maximum": 1.6)", results);
  BOOST_TEST(holds(noise.verdict));
  BOOST_TEST(noise.detail == "the timings are too noisy to tell");
  BOOST_TEST(noise.measured == "median_seconds ratio 2 [1.5, 3]");
  BOOST_TEST(noise.failing == 0u);
}

BOOST_AUTO_TEST_CASE(an_expected_failure_of_timings_is_one_of_the_number_noise_or_not) {
  auto const expected = [](std::string const& limit) {
    return outcome(ratio + limit + R"(, "expect": "fail", "reason": "known")", twice_as_long());
  };
  BOOST_TEST(expected(R"("maximum": 1.4)") == "expected-failure");
  BOOST_TEST(expected(R"("maximum": 1.6)") == "expected-failure", "2 is on the wrong side, 1.5 would not be");
  BOOST_TEST(expected(R"("maximum": 2.5)") == "undecided", "2 is on the right side, 3 would not be");
  BOOST_TEST(expected(R"("maximum": 3)") == "unexpected-pass");
}

BOOST_AUTO_TEST_CASE(a_bound_stays_undecided_where_noise_alone_cannot_explain_it) {
  auto const ladder = [](std::string const& id, double error, double seconds) {
    return std::vector<RunRecord>{
        timed_within(run_at(10, error, id), 0.5 * seconds, seconds, 2.0 * seconds),
        timed_within(run_at(20, error / 100.0, id), 2.0 * seconds, 4.0 * seconds, 8.0 * seconds)};
  };
  // Its coarsest level was good enough: at most 1/2 [1/8, 2] of the other's time.
  auto runs = ladder("conduction/brookshaw", 0.01, 1.0);
  for (RunRecord const& run : ladder("conduction/lucy-flux", 0.2, 1.0)) runs.push_back(run);
  Results const results = results_of(runs);
  std::string const gate = R"("measure": "time_to_error", "relative_to": "conduction/lucy-flux", )";
  BOOST_TEST(outcome(gate + R"("maximum": 2.1)", results) == "passed");
  BOOST_TEST(outcome(gate + R"("maximum": 0.3)", results) == "within-noise");
  BOOST_TEST(outcome(gate + R"("maximum": 0.1)", results) == "undecided");
  BOOST_TEST(outcome(gate + R"("minimum": 0.1)", results) == "undecided");
  BOOST_TEST(outcome(gate + R"("minimum": 2.1)", results) == "failed");
}

BOOST_AUTO_TEST_CASE(a_ratio_of_timings_differs_from_the_baseline_only_if_the_intervals_are_apart) {
  auto const is = [](double low, double median, double high) {
    Results const now = results_of({timed_within(run_at(25, 1.0), low, median, high),
                                    timed_within(run_at(25, 1.0, "conduction/lucy-flux"), 1.0, 1.0, 1.0)});
    std::string const gate = ratio + R"("baseline": "b.json", "within": {"absolute": 0.1})";
    return std::string(word(judged(gate, now, {{"b.json", twice_as_long()}}).verdict));
  };
  BOOST_TEST(is(2.0, 2.05, 2.1) == "passed");
  BOOST_TEST(is(2.9, 4.0, 5.0) == "within-noise");
  BOOST_TEST(is(3.05, 4.0, 5.0) == "within-noise", "the tolerance is beside it");
  BOOST_TEST(is(3.2, 4.0, 5.0) == "failed");
  BOOST_TEST(is(0.5, 1.0, 1.3) == "failed");
}

BOOST_AUTO_TEST_CASE(an_order_without_an_interval_is_undecided) {
  Results const two = results_of({run_at(25, 4e-4), run_at(50, 1e-4)});
  BOOST_TEST(outcome(R"("measure": "order", "minimum": 1)", two) == "undecided");
  BOOST_TEST(outcome(R"("measure": "order", "minimum": 1, "interval": "ignore")", two) == "passed");
  BOOST_TEST(outcome(R"("measure": "order", "minimum": 3)", two) == "failed");
}

BOOST_AUTO_TEST_CASE(a_ladder_may_be_asked_for_its_verdict) {
  std::vector<RunRecord> runs = second_order();
  runs.push_back(run_at(200, 0.25e-4));  // three levels are never asymptotic
  Results const four = results_of(runs);
  BOOST_TEST(outcome(R"("measure": "order", "equals": "asymptotic")", four) == "passed");
  GateVerdict const verdict = judged(R"("measure": "order", "equals": "floored")", four);
  BOOST_TEST((verdict.verdict == Verdict::failed));
  BOOST_TEST(verdict.measured == "ladder asymptotic");
}

BOOST_AUTO_TEST_CASE(an_expected_failure_passes_and_an_unexpected_pass_fails) {
  std::string const expected = R"(, "expect": "fail", "reason": "known")";
  GateVerdict const failing = judged(R"("measure": "error", "maximum": 1e-6)" + expected, smooth());
  BOOST_TEST((failing.verdict == Verdict::expected_failure));
  BOOST_TEST(failing.reason == "known");
  BOOST_TEST(holds(failing.verdict));
  BOOST_TEST(outcome(R"("measure": "error", "maximum": 1)" + expected, smooth()) == "unexpected-pass");
  BOOST_TEST(!holds(Verdict::unexpected_pass));
}

std::string const known = R"(, "expect": "fail", "reason": "known")";

BOOST_AUTO_TEST_CASE(an_expected_failure_is_a_number_on_the_wrong_side_and_nothing_else) {
  // One run on the wrong side, and one that crashed, timed out, or lost its number: something else happened.
  std::string const gate = R"("measure": "error", "maximum": 1e-6, "resolution": "all")" + known;
  BOOST_TEST(outcome(gate, results_of({run_at(25, 1e-3), run_at(50, 1e-3)})) == "expected-failure");
  BOOST_TEST(outcome(gate, results_of({run_at(25, 1e-3), run_at(50, 1e-9)})) == "expected-failure");
  for (char const* status : {"unstable", "timed-out", "invalid", "non-finite"}) {
    RunRecord broken = failed_at(50);
    broken.status = status;
    GateVerdict const verdict = judged(gate, results_of({run_at(25, 1e-3), broken}));
    BOOST_TEST((verdict.verdict == Verdict::failed), status);
    BOOST_TEST(says(verdict.detail, std::string("not the failure that is expected: ") + status),
               verdict.detail);
    BOOST_TEST(says(verdict.where, "N = 50"), verdict.where);
  }
  RunRecord null = run_at(50, std::numeric_limits<double>::quiet_NaN());
  GateVerdict const verdict = judged(gate, results_of({run_at(25, 1e-3), null}));
  BOOST_TEST((verdict.verdict == Verdict::failed));
  BOOST_TEST(says(verdict.detail, "the error is null"), verdict.detail);
}

BOOST_AUTO_TEST_CASE(an_expected_failure_of_an_order_is_a_clear_one) {
  auto const is = [](std::string const& limit, std::string const& verdict, Number order, Number lower,
                     Number upper) {
    return outcome(R"("measure": "order", )" + limit + known,
                   with_order(smooth(), verdict, order, lower, upper));
  };
  std::string const minimum = R"("minimum": 1)";
  BOOST_TEST(is(minimum, "asymptotic", 0.5, 0.4, 0.6) == "expected-failure");
  BOOST_TEST(is(minimum, "asymptotic", 1.5, 1.4, 1.6) == "unexpected-pass");
  BOOST_TEST(is(minimum, "pre-asymptotic", 0.9, 0.7, 1.1) == "undecided", "the limit lies inside");
  BOOST_TEST(is(minimum, "not-refined", {}, {}, {}) == "failed", "a null");
  BOOST_TEST(is(minimum, "floored", 0.2, 0.1, 0.3) == "expected-failure", "a number on the wrong side");
  BOOST_TEST(is(minimum, "floored", 1.2, 1.1, 1.3) == "failed", "the number is on the right side");
  BOOST_TEST(is(minimum, "floored", 0.9, 0.7, 1.1) == "failed");
  BOOST_TEST(is(minimum, "floored", {}, {}, {}) == "failed");
  // A verdict is a word that says as much as a number; too few levels say nothing.
  std::string const equals = R"("equals": "asymptotic")";
  BOOST_TEST(is(equals, "floored", {}, {}, {}) == "expected-failure");
  BOOST_TEST(is(equals, "asymptotic", 1.0, 0.9, 1.1) == "unexpected-pass");
  BOOST_TEST(is(equals, "not-refined", {}, {}, {}) == "failed");
}

BOOST_AUTO_TEST_CASE(an_expected_status_tells_of_the_scheme_not_of_the_machine_or_the_document) {
  auto const is = [](std::string const& equals, std::string const& status) {
    RunRecord run = status == "ok" ? run_at(25, 1.0) : failed_at(25);
    run.status = status;
    return outcome(R"("measure": "status", "equals": ")" + equals + '"' + known, results_of({run}));
  };
  for (char const* status : {"unstable", "non-finite", "positivity-lost"})
    BOOST_TEST(is("ok", status) == "expected-failure", status);
  for (char const* status : {"timed-out", "invalid"}) BOOST_TEST(is("ok", status) == "failed", status);
  BOOST_TEST(is("ok", "ok") == "unexpected-pass");
  BOOST_TEST(is("unstable", "ok") == "expected-failure");
  BOOST_TEST(is("unstable", "timed-out") == "failed");
  BOOST_TEST(is("timed-out", "timed-out") == "unexpected-pass");
}

BOOST_AUTO_TEST_CASE(a_floored_or_diverging_ladder_keeps_no_numeric_limit_of_an_order) {
  Baselines const baselines{{"b.json", with_order(smooth(), "asymptotic", 1.2, 1.1, 1.3)}};
  struct {
    char const* limit;
    double holds, fails;
  } const limits[] = {{R"("minimum": 1)", 1.2, 0.8},
                      {R"("maximum": 1)", 0.8, 1.2},
                      {R"("minimum": 0.5, "maximum": 1)", 0.8, 1.2},
                      {R"("baseline": "b.json", "within": {"relative": 0.1})", 1.2, 0.8}};
  for (auto const& [limit, right, wrong] : limits) {
    auto const is = [&, limit = limit](std::string const& verdict, double order, std::string const& rest) {
      Results const results = with_order(smooth(), verdict, order, order - 0.05, order + 0.05);
      return judged(std::string(R"("measure": "order", )") + limit + rest, results, baselines);
    };
    for (char const* verdict : {"asymptotic", "pre-asymptotic"}) {
      BOOST_TEST((is(verdict, right, "").verdict == Verdict::passed), limit << verdict);
      BOOST_TEST((is(verdict, wrong, "").verdict == Verdict::failed), limit << verdict);
    }
    for (char const* verdict : {"floored", "diverging"}) {
      GateVerdict const refused = is(verdict, right, "");
      BOOST_TEST((refused.verdict == Verdict::failed), limit << verdict);
      BOOST_TEST(refused.detail == std::string("the ladder is ") + verdict + ": made by hand");
      std::string const ignore = R"(, "verdict": "ignore")";
      BOOST_TEST((is(verdict, right, ignore).verdict == Verdict::passed), limit << verdict);
      BOOST_TEST((is(verdict, wrong, ignore).verdict == Verdict::failed), limit << verdict);
    }
  }
}

BOOST_AUTO_TEST_CASE(no_number_is_no_order_whatever_is_ignored) {
  for (char const* limit : {R"("minimum": -9)", R"("maximum": 9)"}) {
    for (char const* rest : {"", R"(, "verdict": "ignore")", R"(, "interval": "ignore")"}) {
      GateVerdict const verdict =
          judged(std::string(R"("measure": "order", )") + limit + rest, with_order(smooth(), "floored", {}));
      BOOST_TEST((verdict.verdict == Verdict::failed), limit << rest);
      BOOST_TEST(verdict.detail == "no order: made by hand");
    }
  }
  BOOST_TEST(outcome(R"("measure": "order", "equals": "floored")", with_order(smooth(), "floored", {})) ==
             "passed");
}

BOOST_AUTO_TEST_CASE(every_entry_of_a_list_must_match_something_unless_a_number_is_said) {
  std::string const gate = R"("measure": "error", "maximum": 1, "select": {"formulation":
                              ["conduction/brookshaw", "conduction/lucy-flx"]})";
  std::vector<RunRecord> runs = second_order();
  GateVerdict const verdict = judged(gate, results_of(runs));
  BOOST_TEST((verdict.verdict == Verdict::selects_nothing));
  BOOST_TEST(says(verdict.detail, "'conduction/lucy-flx' in the list of 'formulation' matches nothing"),
             verdict.detail);
  BOOST_TEST(outcome(gate + R"(, "at_least": 1)", results_of(runs)) == "passed");
  BOOST_TEST(outcome(gate + known, results_of(runs)) == "selects-nothing");
  runs.push_back(run_at(25, 1e-3, "conduction/lucy-flx"));
  BOOST_TEST(outcome(gate, results_of(runs)) == "passed");
}

BOOST_AUTO_TEST_CASE(how_many_are_looked_at_may_be_said) {
  std::string const error = R"("measure": "error", "maximum": 1, "resolution": "all")";
  for (auto const& [rule, expected] :
       {std::pair{R"(, "runs": 3)", "passed"}, std::pair{R"(, "runs": 2)", "failed"},
        std::pair{R"(, "runs": 4)", "failed"}, std::pair{R"(, "at_least": 3)", "passed"},
        std::pair{R"(, "at_least": 2)", "passed"}, std::pair{R"(, "at_least": 4)", "failed"}}) {
    BOOST_TEST(outcome(error + rule, smooth()) == expected, rule);
    if (expected == std::string("failed")) {
      BOOST_TEST(outcome(error + rule + known, smooth()) == "failed", "an expected failure is of a number");
    }
  }
  GateVerdict const verdict = judged(error + R"(, "at_least": 4)", smooth());
  BOOST_TEST(verdict.measured == "3 runs");
  BOOST_TEST(verdict.limit == ">= 4");
  BOOST_TEST(says(verdict.detail, "it looks at 3 runs where 'at_least' says 4"), verdict.detail);
  Results const ladder = with_order(smooth(), "asymptotic", 2.0, 1.9, 2.1);
  BOOST_TEST(outcome(R"("measure": "order", "minimum": 1, "runs": 1)", ladder) == "passed");
  BOOST_TEST(judged(R"("measure": "order", "minimum": 1, "runs": 3)", ladder).measured == "1 ladder");
}

BOOST_AUTO_TEST_CASE(a_part_of_a_baseline_that_is_zero_but_for_rounding_is_what_rounding_explains) {
  auto const with_drift = [](double drift) {
    RunRecord run = run_at(25, 1e-3);
    Budget& energy = run.conservation["energy"];
    energy.initial = energy.final = 2.0;
    energy.drift = drift;
    return results_of({run});
  };
  std::string const gate =
      R"("measure": "conservation", "relative": false, "baseline": "b.json", "within": )";
  auto const is = [&](std::string const& within, double now, double before) {
    return judged(gate + within, with_drift(now), {{"b.json", with_drift(before)}});
  };
  // 64 rounding errors of a budget of 2 J are 2.8e-14 J.
  std::string const tenth = R"({"relative": 0.1})";
  for (double const before : {0.0, 1e-16, 2e-14}) {
    BOOST_TEST((is(tenth, 1e-15, before).verdict == Verdict::passed), before);
    BOOST_TEST((is(tenth, 2.7e-14, before).verdict == Verdict::passed), before);
    BOOST_TEST((is(tenth, 1e-13, before).verdict == Verdict::failed), before);
  }
  BOOST_TEST((is(tenth, 3.5e-14, 3e-14).verdict == Verdict::failed),
             "more than rounding is held to its part");
  BOOST_TEST((is(tenth, 3.2e-14, 3e-14).verdict == Verdict::passed));
  BOOST_TEST((is(R"({"relative": 0.1, "absolute": 0})", 1e-15, 0.0).verdict == Verdict::failed),
             "as is said");
  BOOST_TEST(is(tenth, 1e-15, 0.0).limit == "0 +- 2.8e-14");
}

BOOST_AUTO_TEST_CASE(a_baseline_of_zero_of_which_no_rounding_is_known_must_be_met_and_says_so) {
  auto const with_modes = [](std::uint64_t modes) {
    RunRecord run = run_at(25, 1e-3);
    run.stability.emplace().growing_modes = modes;
    return results_of({run});
  };
  std::string const gate = R"("measure": "stability", "quantity": "growing_modes", "baseline": "b.json",
                              "within": {"relative": 0.5})";
  Baselines const none{{"b.json", with_modes(0)}};
  BOOST_TEST((judged(gate, with_modes(0), none).verdict == Verdict::passed));
  GateVerdict const verdict = judged(gate, with_modes(1), none);
  BOOST_TEST((verdict.verdict == Verdict::failed));
  BOOST_TEST(says(verdict.detail, "give within.absolute"), verdict.detail);
}

BOOST_AUTO_TEST_CASE(a_gate_that_selects_nothing_fails_even_if_it_is_expected_to_fail) {
  std::string const nothing = R"("measure": "error", "maximum": 1, "select": {"case": "hydro/noh"})";
  for (char const* rest : {"", R"(, "expect": "fail", "reason": "known")"}) {
    GateVerdict const verdict = judged(nothing + rest, smooth());
    BOOST_TEST((verdict.verdict == Verdict::selects_nothing));
    BOOST_TEST(!holds(verdict.verdict));
    BOOST_TEST(says(verdict.detail, "no run matches 'case'"), verdict.detail);
  }
  GateVerdict const itself =
      judged(R"("measure": "cost", "maximum": 1, "relative_to": "conduction/brookshaw")", smooth());
  BOOST_TEST((itself.verdict == Verdict::selects_nothing));
  BOOST_TEST(says(itself.detail, "runs of conduction/brookshaw alone, which 'relative_to' names"),
             itself.detail);
}

BOOST_AUTO_TEST_CASE(within_compares_to_the_same_run_of_the_baseline) {
  std::string const gate = R"("measure": "error", "baseline": "b.json", "within": )";
  auto const compare = [&](std::string const& within, std::vector<RunRecord> const& now,
                           std::vector<RunRecord> const& before) {
    return judged(gate + within, results_of(now), {{"b.json", results_of(before)}});
  };
  auto const is = [&](std::string const& within, double now, double before) {
    return std::string(word(compare(within, {run_at(25, now)}, {run_at(25, before)}).verdict));
  };
  BOOST_TEST(is(R"({"relative": 0.1})", 1.05, 1.0) == "passed");
  BOOST_TEST(is(R"({"relative": 0.1})", 0.95, 1.0) == "passed");
  BOOST_TEST(is(R"({"relative": 0.1})", 1.15, 1.0) == "failed");
  BOOST_TEST(is(R"({"relative": 0.1})", 0.85, 1.0) == "failed", "better than it was is a change as well");
  BOOST_TEST(is(R"({"absolute": 0.1})", 1.05, 1.0) == "passed");
  BOOST_TEST(is(R"({"absolute": 0.1})", 1.15, 1.0) == "failed");
  BOOST_TEST(is(R"({"relative": 0.01, "absolute": 0.2})", 1.15, 1.0) == "passed", "the larger counts");
  BOOST_TEST(is(R"({"relative": 0})", 1.0, 1.0) == "passed");
  BOOST_TEST(is(R"({"relative": 0})", 1.0 + 1e-15, 1.0) == "failed");

  std::string const tenth = R"({"relative": 0.1})";
  GateVerdict const shown = compare(tenth, {run_at(25, 2.0)}, {run_at(25, 1.0)});
  BOOST_TEST(shown.limit == "1 +- 0.1");
  // The worst is the one that differs most as a part of its tolerance.
  auto const lucy = [](double error) { return run_at(25, error, "conduction/lucy-flux"); };
  GateVerdict const worst = compare(tenth, {run_at(25, 103.0), lucy(1.05)}, {lucy(1.0), run_at(25, 100.0)});
  BOOST_TEST((worst.verdict == Verdict::passed));
  BOOST_TEST(says(worst.where, "lucy-flux"), worst.where);

  GateVerdict const fresh = compare(tenth, {run_at(25, 1.0), lucy(1.0)}, {run_at(25, 1.0)});
  BOOST_TEST((fresh.verdict == Verdict::failed));
  BOOST_TEST(fresh.detail == "not in the baseline");
  GateVerdict const lost = compare(tenth, {run_at(25, 1.0)}, {run_at(25, 1.0), lucy(1.0)});
  BOOST_TEST((lost.verdict == Verdict::failed));
  BOOST_TEST(lost.detail == "in the baseline, but no longer in the results");
  GateVerdict const broken = compare(tenth, {run_at(25, 1.0)}, {failed_at(25)});
  BOOST_TEST((broken.verdict == Verdict::failed));
  BOOST_TEST(broken.detail == "baseline: unstable: the temperature ran away");
}

BOOST_AUTO_TEST_CASE(baselines_are_read_and_may_not_be_the_results_themselves) {
  TemporaryFolder const folder;
  write_text(folder.file("results.json"), document_text(to_json(smooth())));
  Json document = gates_document({R"("measure": "error", "within": {"relative": 0.1})"});
  document["baseline"] = "results.json";
  Gates const gates = read_gates(Node(document, folder.file("gates.json")));
  std::string const said = complaint([&] { read_baselines(gates, folder.file("results.json")); });
  BOOST_TEST(says(said, "gates[0].baseline: found the results themselves"), said);
  write_text(folder.file("now.json"), "{}");
  Baselines const baselines = read_baselines(gates, folder.file("now.json"));
  BOOST_TEST_REQUIRE(baselines.size() == 1u);
  BOOST_TEST(baselines.begin()->second.runs.size() == 3u);
}

BOOST_AUTO_TEST_SUITE_END()
