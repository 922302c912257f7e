// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/gate/measure.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>

#include "harness/measure/timing.hpp"

#include "tests/unit/harness/gate/small_results.hpp"

BOOST_AUTO_TEST_SUITE(harness_gate_measure)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

double const nan = std::numeric_limits<double>::quiet_NaN();

std::vector<Measured> measured(std::string const& gate, Results const& results) {
  return measure(gate_of(gate), results, "gates.json");
}

/// The value of the only entry.
double value(std::string const& gate, Results const& results) {
  auto const all = measured(gate, results);
  BOOST_TEST_REQUIRE(all.size() == 1u);
  BOOST_TEST_REQUIRE(all[0].value.has_value(), all[0].problem);
  return *all[0].value;
}

/// Why the only entry has no value.
std::string problem(std::string const& gate, Results const& results) {
  auto const all = measured(gate, results);
  BOOST_TEST_REQUIRE(all.size() == 1u);
  BOOST_TEST(!all[0].value.has_value());
  return all[0].problem;
}

std::string refusal(std::string const& gate, Results const& results) {
  return complaint([&] { measured(gate, results); });
}

BOOST_AUTO_TEST_CASE(an_error_is_that_of_the_finest_level_in_the_named_region_and_norm) {
  Results const results = results_of(second_order());
  BOOST_TEST(value(R"("measure": "error", "maximum": 1)", results) == 1e-4);
  BOOST_TEST(value(R"("measure": "error", "maximum": 1, "norm": "linf")", results) == 2e-4);
  BOOST_TEST(value(R"("measure": "error", "maximum": 1, "region": "wall", "norm": "l1")", results) == 1e-4);
  BOOST_TEST(value(R"("measure": "error", "maximum": 1, "resolution": 25)", results) == 16e-4);
  BOOST_TEST(value(R"("measure": "error", "maximum": 1, "relative": true)", results) == 0.5e-4);
  BOOST_TEST(value(R"("measure": "error", "maximum": 1, "select": {"resolution": [25, 50]})", results) ==
             4e-4);
  BOOST_TEST(measured(R"("measure": "error", "maximum": 1, "resolution": "all")", results).size() == 3u);
  BOOST_TEST(measured(R"("measure": "error", "maximum": 1, "resolution": 26)", results).empty());
}

BOOST_AUTO_TEST_CASE(each_seed_of_each_series_is_looked_at) {
  Results const results =
      results_of({seeded(run_at(25, 1.0), 1), seeded(run_at(25, 2.0), 2), seeded(run_at(50, 0.5), 1),
                  seeded(run_at(50, 0.7), 2), run_at(40, 0.1, "conduction/lucy-flux")});
  auto const all = measured(R"("measure": "error", "maximum": 1)", results);
  BOOST_TEST_REQUIRE(all.size() == 3u);
  BOOST_TEST(*all[0].value == 0.5);
  BOOST_TEST(*all[1].value == 0.7);
  BOOST_TEST(*all[2].value == 0.1);
}

BOOST_AUTO_TEST_CASE(what_does_not_exist_in_any_run_is_refused_and_what_does_is_named) {
  Results const results = results_of(second_order());
  BOOST_TEST(refusal(R"("measure": "error", "maximum": 1, "field": "temprature")", results) ==
             "gates.json: gates[0].field: found 'temprature', expected one of temperature (did you mean "
             "'temperature'?)");
  BOOST_TEST(says(refusal(R"("measure": "error", "maximum": 1, "region": "corner")", results),
                  "gates[0].region: found 'corner', expected one of all, wall"));
  BOOST_TEST(says(refusal(R"("measure": "order", "minimum": 1, "region": "corner")", results),
                  "gates[0].region: found 'corner', expected one of all, wall"));
  BOOST_TEST(says(refusal(R"("measure": "order", "minimum": 1, "field": "flux")", results),
                  "gates[0].field: found 'flux', expected one of temperature"));
  BOOST_TEST(says(refusal(R"("measure": "conservation", "maximum": 1)", results),
                  "gates[0].quantity: found 'energy', expected what the selected runs have measured"));
  BOOST_TEST(says(refusal(R"("measure": "stability", "maximum": 1)", results), "found 'stability'"));
  BOOST_TEST(says(refusal(R"("measure": "wall_flux", "maximum": 1)", results), "found 'wall_flux'"));
  BOOST_TEST(says(refusal(R"("measure": "cost", "maximum": 1, "relative_to": "conduction/lucy")",
                          results_of({timed(run_at(25, 1.0), 1.0)})),
                  "gates[0].relative_to: found 'conduction/lucy', expected one of conduction/brookshaw"));
}

BOOST_AUTO_TEST_CASE(of_a_baseline_what_does_not_exist_is_only_a_problem) {
  Results const results = results_of(second_order());
  Gate const gate = gate_of(R"("measure": "error", "maximum": 1, "field": "flux")");
  auto const all = measure_baseline(gate, results);
  BOOST_TEST_REQUIRE(all.size() == 1u);
  BOOST_TEST(!all[0].value.has_value());
  BOOST_TEST(says(all[0].problem, "no error of flux"));
}

BOOST_AUTO_TEST_CASE(a_failed_run_has_no_number_but_status_and_reason) {
  auto runs = second_order();
  runs.push_back(failed_at(200));
  Results const results = results_of(runs);
  BOOST_TEST(problem(R"("measure": "error", "maximum": 1)", results) == "unstable: the temperature ran away");
  BOOST_TEST(problem(R"("measure": "order", "minimum": 1)", results) ==
             "at N = 200 unstable: the temperature ran away");
  auto const statuses = measured(R"("measure": "status", "equals": "ok")", results);
  BOOST_TEST_REQUIRE(statuses.size() == 4u);
  BOOST_TEST(statuses[0].word == "ok");
  BOOST_TEST(statuses[3].word == "unstable");
  // Of runs that all failed no name can be checked.
  BOOST_TEST(problem(R"("measure": "error", "maximum": 1, "field": "x")", results_of({failed_at(25)})) ==
             "unstable: the temperature ran away");
}

BOOST_AUTO_TEST_CASE(a_null_is_a_problem) {
  RunRecord run = run_at(25, nan);
  run.errors["temperature"]["wall"].scale.l2 = 0.0;
  run.errors["temperature"]["wall"].error.l2 = 1.0;
  Results const results = results_of({run});
  BOOST_TEST(says(problem(R"("measure": "error", "maximum": 1)", results), "null"));
  BOOST_TEST(says(problem(R"("measure": "error", "maximum": 1, "region": "wall", "relative": true)", results),
                  "zero or null"));
}

BOOST_AUTO_TEST_CASE(an_order_comes_with_interval_and_verdict) {
  auto const all = measured(R"("measure": "order", "minimum": 1)", results_of(scattered()));
  BOOST_TEST_REQUIRE(all.size() == 1u);
  BOOST_TEST_REQUIRE((all[0].lower && all[0].upper));
  BOOST_TEST(*all[0].lower < *all[0].value);
  BOOST_TEST(*all[0].value < *all[0].upper);
  BOOST_TEST(all[0].word == results_of(scattered()).series[0].orders[0].observed.verdict);
  BOOST_TEST(value(R"("measure": "order", "minimum": 1)", results_of(second_order())) == 2.0,
             tolerance(1e-4));
  BOOST_TEST(says(problem(R"("measure": "order", "minimum": 1)", results_of({run_at(25, 1.0)})), "no order"));
}

BOOST_AUTO_TEST_CASE(a_budget_is_relative_to_the_largest_of_what_was_there_and_what_was_exchanged) {
  RunRecord run = run_at(25, 1.0);
  run.conservation["energy"] = {2.0, 3.0, 8.0, -0.4, -0.2, 0.1};
  run.conservation["mass"] = {0.0, 0.0, 0.0, 0.0, {}, {}};
  Results const results = results_of({run});
  auto const budget = [](std::string const& rest) {
    return R"("measure": "conservation", "maximum": 1)" + rest;
  };
  BOOST_TEST(value(budget(""), results) == 0.4 / 8.0);
  BOOST_TEST(value(budget(R"(, "relative": false)"), results) == 0.4);
  BOOST_TEST(value(budget(R"(, "what": "pair_drift")"), results) == 0.2 / 8.0);
  BOOST_TEST(value(budget(R"(, "what": "wall_budget_defect")"), results) == 0.1 / 8.0);
  BOOST_TEST(value(budget(R"(, "quantity": "mass")"), results) == 0.0);
  BOOST_TEST(problem(budget(R"(, "quantity": "mass", "what": "pair_drift")"), results) ==
             "pair_drift is null");
  run.conservation["mass"].drift = 1e-3;
  BOOST_TEST(says(problem(budget(R"(, "quantity": "mass")"), results_of({run})), "nothing was there"));
}

BOOST_AUTO_TEST_CASE(momentum_is_relative_to_what_the_walls_push) {
  RunRecord run = run_at(25, 1.0);
  run.momentum = {{0.0, 0.0, 0.0, 1e-3, {}, {}}, {0.0, 0.1, 0.0, -2e-3, {}, {}}};
  run.wall_budgets.resize(2);
  run.wall_budgets[0].prescribed_impulse = {0.5, 0.0};
  run.wall_budgets[1].prescribed_impulse = {-0.5, 0.0};
  std::string const gate = R"("measure": "conservation", "quantity": "momentum", "maximum": 1)";
  BOOST_TEST(value(gate, results_of({run})) == 2e-3 / 0.5);
}

BOOST_AUTO_TEST_CASE(a_wall_flux_is_the_worst_of_the_walls_or_that_of_one) {
  RunRecord run = run_at(25, 1.0);
  run.wall_flux = {{1.1, 1.0, 0.1, 2.0}, {0.7, 1.0, -0.3, 2.0}};
  Results const results = results_of({run});
  BOOST_TEST(value(R"("measure": "wall_flux", "maximum": 1)", results) == 0.15);
  BOOST_TEST(value(R"("measure": "wall_flux", "maximum": 1, "wall": 0)", results) == 0.05);
  BOOST_TEST(value(R"("measure": "wall_flux", "maximum": 1, "relative": false)", results) == 0.3);
  BOOST_TEST(says(refusal(R"("measure": "wall_flux", "maximum": 1, "wall": 2)", results),
                  "gates[0].wall: found '2', expected one of 0, 1"));
  run.wall_flux[1].scale = 0.0;
  BOOST_TEST(says(problem(R"("measure": "wall_flux", "maximum": 1)", results_of({run})), "wall 1"));
}

BOOST_AUTO_TEST_CASE(skill_is_the_error_over_that_of_doing_nothing) {
  RunRecord run = run_at(25, 0.5);
  run.errors["temperature"]["all"].initial = NormSet{1.0, 2.0, 5.0};
  run.errors["temperature"]["wall"].initial = NormSet{0.0, 0.0, 0.0};
  Results const results = results_of({run});
  std::string const skill = R"("measure": "skill", "maximum": 1)";
  BOOST_TEST(value(skill, results) == 0.25);
  BOOST_TEST(value(skill + R"(, "norm": "linf")", results) == 0.2);
  BOOST_TEST(value(skill + R"(, "norm": "l1")", results) == 0.25);
  BOOST_TEST(problem(skill + R"(, "region": "wall")", results) ==
             "the error is null, or that of doing nothing is zero or null");
  BOOST_TEST(problem(skill, results_of({run_at(25, 0.5)})) == "the error of doing nothing was not measured");
  BOOST_TEST(says(refusal(skill + R"(, "field": "temprature")", results), "did you mean 'temperature'?"));
  BOOST_TEST(says(refusal(skill + R"(, "region": "wal")", results), "did you mean 'wall'?"));
  // The finest level counts unless another is named.
  RunRecord fine = run;
  fine.resolution = 50;
  fine.errors["temperature"]["all"].error.l2 = 0.1;
  BOOST_TEST(value(skill, results_of({run, fine})) == 0.05);
  BOOST_TEST(value(skill + R"(, "resolution": 25)", results_of({run, fine})) == 0.25);
}

BOOST_AUTO_TEST_CASE(the_share_of_the_time_error_is_of_every_level) {
  RunRecord run = run_at(25, 0.5);
  std::string const share = R"("measure": "time_error", "maximum": 1)";
  BOOST_TEST(
      says(refusal(share, results_of({run})), "what the selected runs have measured, which is none of it"));
  run.integration.emplace();
  BOOST_TEST(problem(share, results_of({run})) == "the time error was not measured");
  run.integration->time_error_share = 0.02;
  RunRecord fine = run;
  fine.resolution = 50;
  fine.integration->time_error_share = 0.3;
  auto const all = measured(share, results_of({run, fine}));
  BOOST_TEST_REQUIRE(all.size() == 2u);
  BOOST_TEST(*all[0].value == 0.02);
  BOOST_TEST(*all[1].value == 0.3);
  BOOST_TEST(*all[0].round_off == 1e-15 / 0.25, tolerance(1e-12));
  // An error of zero says nothing of its rounding.
  run.errors["temperature"]["all"].error.l1 = 0.0;
  BOOST_TEST(*measured(share, results_of({run})).at(0).round_off < 1.0);
}

BOOST_AUTO_TEST_CASE(rounding_is_known_of_what_may_be_zero) {
  RunRecord run = run_at(25, 0.5);
  run.errors["temperature"]["all"].initial = NormSet{1.0, 2.0, 5.0};
  run.wall_flux = {{3.0, 1.0, 2.0, 4.0}};
  run.conservation["energy"] = {1.0, 5.0, 4.0, 1e-3, {}, {}};
  Stability& s = run.stability.emplace();
  s.spectral_abscissa = 1e-13;
  s.abscissa_uncertainty = 3e-11;
  s.growing_modes = 0;
  Results const results = results_of({run});
  auto const rounding = [&](std::string const& gate) {
    Number const found = measured(gate, results).at(0).round_off;
    return found ? *found : -1.0;
  };
  double const eps = 64.0 * std::numeric_limits<double>::epsilon();
  BOOST_TEST(rounding(R"("measure": "error", "maximum": 1)") == 1e-15);
  BOOST_TEST(rounding(R"("measure": "error", "maximum": 1, "relative": true)") == 0.5e-15);
  BOOST_TEST(rounding(R"("measure": "skill", "maximum": 1)") == 0.5e-15);
  BOOST_TEST(rounding(R"("measure": "conservation", "maximum": 1, "relative": false)") == 5.0 * eps);
  BOOST_TEST(rounding(R"("measure": "conservation", "maximum": 1)") == eps);
  BOOST_TEST(rounding(R"("measure": "wall_flux", "maximum": 1, "relative": false)") == 4.0 * eps);
  BOOST_TEST(rounding(R"("measure": "wall_flux", "maximum": 1)") == eps);
  BOOST_TEST(rounding(R"("measure": "stability", "maximum": 1)") == 3e-11);
  BOOST_TEST(rounding(R"("measure": "stability", "quantity": "growing_modes", "maximum": 1)") == -1.0);
  // Of an order: what it may change the logarithm of an error by, at both ends.
  Number const order =
      measured(R"("measure": "order", "minimum": 1)", results_of(second_order())).at(0).round_off;
  BOOST_TEST(*order == 2.0 * 1e-15 / 1e-4 / std::log(4.0), tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(runs_that_took_turns_are_compared_round_by_round) {
  std::string const lucy = "conduction/lucy-flux";
  // The machine slows down to a fifth: neither the medians' ends nor the minima see what every round says.
  std::vector<double> const pace{1.0, 1.1, 1.3, 1.6, 2.0, 2.5, 3.1, 3.8, 4.5, 5.0};
  auto const in_turn = [&](std::string const& id, double seconds, std::string const& occasion) {
    RunRecord run = run_at(25, 1.0, id);
    Cost& cost = run.cost.emplace();
    cost.occasion = occasion;
    for (double const slow : pace) cost.round_seconds.push_back(seconds * slow);
    cost.seconds = seconds;
    cost.median = median_of(cost.round_seconds);
    return run;
  };
  std::string const gate =
      R"("measure": "cost", "quantity": "median_seconds", "maximum": 1, "relative_to": "conduction/lucy-flux")";
  auto const of = [&](RunRecord const& own, RunRecord const& its) {
    return measured(gate, results_of({own, its})).at(0);
  };
  Measured m = of(in_turn("conduction/brookshaw", 1.2, "a"), in_turn(lucy, 1.0, "a"));
  BOOST_TEST(*m.value == 1.2, tolerance(1e-12));
  BOOST_TEST(*m.lower == 1.2, tolerance(1e-12));
  BOOST_TEST(*m.upper == 1.2, tolerance(1e-12));
  BOOST_TEST(*m.kindest_lower == *m.upper);
  // Rounds of different occasions have nothing to do with each other.
  m = of(in_turn("conduction/brookshaw", 1.2, "a"), in_turn(lucy, 1.0, "b"));
  BOOST_TEST(*m.lower < 0.5);
  BOOST_TEST(*m.upper > 3.0);
}

BOOST_AUTO_TEST_CASE(a_spectrum_is_measured_whatever_became_of_the_run) {
  RunRecord run = failed_at(25);
  Stability& s = run.stability.emplace();
  s.spectral_abscissa = 3.0;
  s.spectral_radius = 40.0;
  s.growing_modes = 2;
  s.remark = "a mode grows";
  Results const results = results_of({run});
  BOOST_TEST(value(R"("measure": "stability", "maximum": 1)", results) == 3.0);
  BOOST_TEST(value(R"("measure": "stability", "quantity": "spectral_radius", "maximum": 1)", results) ==
             40.0);
  BOOST_TEST(value(R"("measure": "stability", "quantity": "growing_modes", "maximum": 1)", results) == 2.0);
  BOOST_TEST(problem(R"("measure": "stability", "quantity": "largest_stable_step", "minimum": 1)", results) ==
             "largest_stable_step is null: a mode grows");
}

BOOST_AUTO_TEST_CASE(a_cost_is_the_ratio_to_the_same_run_of_another_formulation) {
  std::vector<RunRecord> const runs{timed(seeded(run_at(25, 1.0), 1), 2.0, 30),
                                    timed(seeded(run_at(25, 1.0), 2), 3.0, 30),
                                    timed(seeded(run_at(25, 1.0, "conduction/lucy-flux"), 1), 1.0, 10),
                                    timed(seeded(run_at(25, 1.0, "conduction/lucy-flux"), 2), 6.0, 60)};
  std::string const seconds = R"("measure": "cost", "maximum": 1, "relative_to": "conduction/lucy-flux")";
  auto all = measured(seconds, results_of(runs));
  BOOST_TEST_REQUIRE(all.size() == 2u, "lucy-flux is not compared to itself");
  BOOST_TEST(*all[0].value == 2.0);
  BOOST_TEST(*all[1].value == 0.5);
  all = measured(seconds + R"(, "quantity": "steps")", results_of(runs));
  BOOST_TEST(*all[0].value == 3.0);
  auto broken = runs;
  broken[2].status = "timed-out";
  broken[3].cost.reset();
  all = measured(seconds, results_of(broken));
  BOOST_TEST(all[0].problem == "conduction/lucy-flux: timed-out");
  BOOST_TEST(all[1].problem == "conduction/lucy-flux: cost was not measured");
  broken = {runs[0], runs[3]};
  BOOST_TEST(problem(seconds, results_of(broken)) == "conduction/lucy-flux was not run on this");
}

BOOST_AUTO_TEST_CASE(a_ratio_to_the_same_form_without_walls_and_one_between_partners) {
  RunRecord off = timed(run_at(25, 1.0), 4.0);
  off.formulation.walls = false;
  std::string const walls =
      R"("measure": "cost", "maximum": 1, "relative_to": {"id": "conduction/brookshaw", "walls": "off"})";
  BOOST_TEST(value(walls, results_of({timed(run_at(25, 1.0), 2.0), off})) == 0.5);

  auto const gas = [](std::string const& id, std::string const& work, double seconds) {
    RunRecord run = timed(run_at(25, 1.0, id), seconds);
    run.formulation.work = work;
    run.label = id + " + " + work;
    return run;
  };
  std::string const partners = R"("measure": "cost", "maximum": 1, "relative_to": "momentum/p-rho2",
                                  "select": {"formulation": "momentum/sqrt-p"})";
  std::vector<RunRecord> runs{gas("momentum/sqrt-p", "a", 6.0), gas("momentum/p-rho2", "a", 2.0),
                              gas("momentum/p-rho2", "b", 3.0)};
  BOOST_TEST(value(partners, results_of(runs)) == 3.0, "the one with the same partner");
  runs[0].formulation.work = "c";
  BOOST_TEST(says(refusal(partners, results_of(runs)),
                  "gates[0].relative_to: found momentum/p-rho2 + a and momentum/p-rho2 + b, expected work"));
}

BOOST_AUTO_TEST_CASE(a_time_to_error_that_is_a_bound_makes_an_interval) {
  auto const ladder = [](std::string const& id, double error, double seconds) {
    return std::vector<RunRecord>{timed(run_at(10, error, id), seconds),
                                  timed(run_at(20, error / 100.0, id), 4.0 * seconds)};
  };
  auto const both = [](std::vector<RunRecord> a, std::vector<RunRecord> const& b) {
    a.insert(a.end(), b.begin(), b.end());
    return results_of(a);
  };
  std::string const gate =
      R"("measure": "time_to_error", "maximum": 1, "relative_to": "conduction/lucy-flux")";
  // The exact norm is 2: 1% is 0.02, which an error of 0.2 reaches halfway, at twice the first time.
  auto all = measured(
      gate, both(ladder("conduction/brookshaw", 0.2, 3.0), ladder("conduction/lucy-flux", 0.2, 1.0)));
  BOOST_TEST_REQUIRE(all.size() == 1u);
  BOOST_TEST(*all[0].value == 3.0, tolerance(1e-12));
  BOOST_TEST(!all[0].lower.has_value());
  all = measured(gate,
                 both(ladder("conduction/brookshaw", 0.01, 3.0), ladder("conduction/lucy-flux", 0.2, 1.0)));
  BOOST_TEST(*all[0].lower == 0.0);
  BOOST_TEST(*all[0].upper == *all[0].value);
  BOOST_TEST(*all[0].value == 1.5, tolerance(1e-12));
  all = measured(gate,
                 both(ladder("conduction/brookshaw", 0.2, 3.0), ladder("conduction/lucy-flux", 0.01, 1.0)));
  BOOST_TEST(*all[0].lower == *all[0].value);
  BOOST_TEST(std::isinf(*all[0].upper));
  Results const never =
      both(ladder("conduction/brookshaw", 90.0, 3.0), ladder("conduction/lucy-flux", 0.2, 1.0));
  BOOST_TEST(problem(gate, never) == "conduction/brookshaw never reached 0.01 of the exact norm");
  BOOST_TEST(says(refusal(gate + R"(, "target": 0.5)", never),
                  "gates[0].target: found '0.5', expected one of 0.001, 0.01, 0.1"));
}

BOOST_AUTO_TEST_CASE(a_ratio_of_timings_has_the_interval_of_their_ends_divided) {
  std::string const lucy = "conduction/lucy-flux";
  RunRecord own = timed_within(run_at(25, 1.0), 2.0, 2.4, 3.0);
  RunRecord const its = timed_within(run_at(25, 1.0, lucy), 1.0, 1.2, 1.5);
  std::string const gate = R"("measure": "cost", "maximum": 1, "relative_to": "conduction/lucy-flux")";
  auto const of = [&](std::string const& rest) {
    return measured(gate + rest, results_of({own, its})).at(0);
  };
  Measured m = of(R"(, "quantity": "median_seconds")");
  BOOST_TEST(*m.value == 2.0);
  BOOST_TEST(*m.lower == 2.0 / 1.5);
  BOOST_TEST(*m.upper == 3.0 / 1.0);
  BOOST_TEST(*m.kindest_lower == *m.upper);
  BOOST_TEST(*m.kindest_upper == *m.lower);
  m = of("");
  BOOST_TEST(*m.value == 2.0, "of the fastest repeats");
  BOOST_TEST(*m.lower == 2.0 / 1.5);
  own.cost->seconds = 1.0;
  BOOST_TEST(*of("").value == 1.0);
  BOOST_TEST(*of("").lower == 1.0, "the interval holds what is measured");
  own.cost->cpu_seconds = 1.0;
  BOOST_TEST(!of(R"(, "quantity": "steps")").lower.has_value());
  own.cost->median.low.reset();
  BOOST_TEST(!of("").lower.has_value());
}

BOOST_AUTO_TEST_CASE(a_ratio_of_times_to_an_error_is_one_of_medians_with_their_interval) {
  std::string const lucy = "conduction/lucy-flux";
  auto const both = [&](double own_error, double its_error) {
    return results_of({timed_within(run_at(10, own_error), 2.0, 3.0, 4.0),
                       timed_within(run_at(20, own_error / 100.0), 8.0, 12.0, 16.0),
                       timed_within(run_at(10, its_error, lucy), 1.0, 1.0, 2.0),
                       timed_within(run_at(20, its_error / 100.0, lucy), 4.0, 4.0, 8.0)});
  };
  std::string const gate =
      R"("measure": "time_to_error", "maximum": 1, "relative_to": "conduction/lucy-flux")";
  // As above, an error of 0.2 reaches 1% halfway: medians 6 [4, 8] over 2 [2, 4].
  Measured m = measured(gate, both(0.2, 0.2)).at(0);
  BOOST_TEST(*m.value == 3.0, tolerance(1e-12));
  BOOST_TEST(*m.lower == 1.0, tolerance(1e-12));
  BOOST_TEST(*m.upper == 4.0, tolerance(1e-12));
  BOOST_TEST(*m.kindest_lower == *m.upper);
  // At most 3 [2, 4] over 2 [2, 4].
  m = measured(gate, both(0.01, 0.2)).at(0);
  BOOST_TEST(*m.lower == 0.0);
  BOOST_TEST(*m.upper == 2.0, tolerance(1e-12));
  BOOST_TEST(*m.kindest_lower == 0.0);
  BOOST_TEST(*m.kindest_upper == 0.5, tolerance(1e-12));
  // 6 [4, 8] over at most 1 [1, 2].
  m = measured(gate, both(0.2, 0.01)).at(0);
  BOOST_TEST(*m.lower == 2.0, tolerance(1e-12));
  BOOST_TEST(std::isinf(*m.upper));
  BOOST_TEST(*m.kindest_lower == 8.0, tolerance(1e-12));
  BOOST_TEST(std::isinf(*m.kindest_upper));
  // A document may hold a median that is no time.
  Results timeless = both(0.2, 0.2);
  for (Series& series : timeless.series) {
    for (TimeToError& t : series.time_to_error) t.median.median = 0.0;
  }
  m = measured(gate, timeless).at(0);
  BOOST_TEST(!m.value.has_value());
  BOOST_TEST(says(m.problem, "is zero"), m.problem);
}

BOOST_AUTO_TEST_CASE(a_subject_is_described_by_what_is_not_default) {
  RunRecord run = seeded(run_at(25, 1.0), 3);
  run.parameters = {{"left", 1.0}, {"final_time", 0.04}};
  Results const results = results_of({run});
  auto const all = measured(R"("measure": "error", "maximum": 1)", results);
  std::string const text = describe(all[0]);
  BOOST_TEST(says(text, R"(conduction/slab-dirichlet {"final_time":0.04}, conduction/brookshaw)"), text);
  BOOST_TEST(says(text, "jittered 0.1 seed 3"), text);
  BOOST_TEST(says(text, "N = 25"), text);
}

BOOST_AUTO_TEST_CASE(numbers_have_the_unit_of_their_field) {
  BOOST_TEST(unit_of(gate_of(R"("measure": "error", "maximum": 1)"), "temperature") == "K");
  BOOST_TEST(unit_of(gate_of(R"("measure": "error", "maximum": 1, "relative": true)"), "velocity") == "");
  BOOST_TEST(unit_of(gate_of(R"("measure": "stability", "maximum": 1)"), "") == "1/s");
}

BOOST_AUTO_TEST_SUITE_END()
