// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/changes.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <utility>

#include "harness/measure/series.hpp"
#include "reports/table/changes_table.hpp"

BOOST_AUTO_TEST_SUITE(reports_table_changes)

using namespace sphverify;

/// A ladder of heat conduction whose error falls with the square of the spacing; adaptive steps.
struct Ladder {
  std::string formulation = "conduction/brookshaw";
  double error = 1e-3;
  double order = 2.0;
  std::vector<int> resolutions{25, 50, 100};
  std::string last_status = "ok";
  double time_error_share = 0.001;
  double wall_flux = 0.01;
  double drift = 0.0, pair_drift = 0.0;
  std::uint64_t seeds = 1, first_seed = 0;
};

Results results_of(std::vector<Ladder> const& ladders) {
  Results results;
  for (Ladder const& ladder : ladders) {
    for (int const n : ladder.resolutions) {
      for (std::uint64_t seed = 0; seed < ladder.seeds; ++seed) {
        RunRecord& run = results.runs.emplace_back();
        run.case_id = "conduction/slab-dirichlet";
        run.parameters["final_time"] = 0.05;
        run.formulation.id = run.label = ladder.formulation;
        if (ladder.first_seed > 0) run.discretisation.layout = {"jittered", 0.1, ladder.first_seed + seed};
        run.resolution = n;
        run.spacing = 1.0 / n;
        run.smoothing_length = 1.2 / n;
        if (n == ladder.resolutions.back()) run.status = ladder.last_status;
        if (run.status != "ok") continue;
        double const scatter = 1.0 + 0.1 * static_cast<double>(seed);
        double const e = ladder.error * scatter * std::pow(25.0 / n, ladder.order);
        run.errors["temperature"]["all"] = {{e, e, e}, {2.0, 2.0, 2.0}, 1e-15};
        run.integration.emplace().relative_tolerance = 1e-6;
        run.integration->time_error_share = ladder.time_error_share;
        run.wall_flux = {{1.0 + ladder.wall_flux, 1.0, ladder.wall_flux, 1.0}};
        run.conservation["energy"] = {1.0, 1.0, 0.0, ladder.drift, ladder.pair_drift, {}};
        run.cost.emplace().steps = 100;
      }
    }
  }
  results.series = build_series(results.runs);
  return results;
}

/// What the second says that the first does not. The first comes first.
struct Compared {
  std::vector<NamedResults> documents;
  Changes changes;

  Compared(Results before, Results after)
      : documents{{"before", std::move(before)}, {"after", std::move(after)}},
        changes(changes_of(documents, "all", "").at(0)) {}

  MeasureCount count(std::string const& measure) const {
    for (MeasureCount const& c : changes.counts) {
      if (c.measure == measure) return c;
    }
    return {};
  }
};

BOOST_AUTO_TEST_CASE(what_repeats_exactly_has_not_changed) {
  Compared const c(results_of({Ladder{}}), results_of({Ladder{}}));
  BOOST_TEST(c.changes.in_both == 1);
  BOOST_TEST(c.changes.list.empty());
  for (char const* measure : {"status", "error", "order", "verdict", "wall flux", "energy drift"})
    BOOST_TEST(c.count(measure).same == 1, measure);
}

BOOST_AUTO_TEST_CASE(an_error_moved_by_less_than_both_time_errors_is_noise_and_by_more_is_a_change) {
  auto const moved = [](double factor) {
    return Compared(results_of({Ladder{}}), results_of({Ladder{.error = 1e-3 * factor}}));
  };
  BOOST_TEST(moved(1.0019).count("error").within_noise == 1);
  BOOST_TEST(moved(1.0021).count("error").worse == 1);
  Compared const half = moved(0.5);
  BOOST_TEST(half.count("error").better == 1);
  Change const& change = half.changes.list.front();
  BOOST_TEST(change.measure == "error");
  BOOST_TEST(change.direction == "better");
  BOOST_TEST(change.resolution == 100);
  BOOST_TEST(std::abs(*change.before - 1e-3 / 16.0) < 1e-12);
  BOOST_TEST(std::abs(*change.noise - 0.002 * *change.before) < 1e-12);
  BOOST_TEST(std::abs(change.size - 1.0) < 1e-9);
}

BOOST_AUTO_TEST_CASE(where_a_time_error_is_not_known_numbers_that_differ_are_not_judged) {
  auto const unknown = [](double error) {
    Results results = results_of({Ladder{.error = error}});
    results.runs.back().integration->time_error_share.reset();
    return results;
  };
  for (auto const& [before, after] : {std::pair{unknown(1e-3), results_of({Ladder{.error = 1.5e-3}})},
                                      {results_of({Ladder{}}), unknown(1.5e-3)}}) {
    Compared const c(before, after);
    BOOST_TEST(c.count("error").worse == 0);
    BOOST_TEST(c.count("error").within_noise == 0);
    BOOST_TEST(c.count("wall flux").same == 1);
    BOOST_TEST(c.changes.unknown_noise.size() == 1u);
  }
  Compared const same(unknown(1e-3), unknown(1e-3));
  BOOST_TEST(same.count("error").same == 1);
  BOOST_TEST(same.changes.unknown_noise.empty());
}

BOOST_AUTO_TEST_CASE(without_adaptive_steps_only_rounding_is_noise) {
  auto const fixed_steps = [](double error) {
    Results results = results_of({Ladder{.error = error}});
    for (RunRecord& run : results.runs) run.integration->relative_tolerance.reset();
    return results;
  };
  BOOST_TEST(Compared(fixed_steps(1e-3), fixed_steps(1.00001e-3)).count("error").worse == 1);
  BOOST_TEST(Compared(fixed_steps(1e-3), fixed_steps(1.0000001e-3)).count("error").within_noise == 1);
}

BOOST_AUTO_TEST_CASE(errors_at_round_off_may_be_any) {
  Compared const c(results_of({Ladder{.error = 1e-16, .order = 0.0}}),
                   results_of({Ladder{.error = 1e-15, .order = 0.0}}));
  BOOST_TEST(c.count("error").within_noise == 1);
}

BOOST_AUTO_TEST_CASE(a_failure_is_the_largest_change_and_hides_the_numbers_of_its_series) {
  Compared const c(results_of({Ladder{}, Ladder{.formulation = "conduction/lucy-flux"}}),
                   results_of({Ladder{.error = 2e-3},
                               Ladder{.formulation = "conduction/lucy-flux", .last_status = "unstable"}}));
  Change const& first = c.changes.list.front();
  BOOST_TEST(first.measure == "status");
  BOOST_TEST(first.direction == "worse");
  BOOST_TEST(first.before_word == "ok");
  BOOST_TEST(first.after_word == "unstable 1/1");
  BOOST_TEST(first.setting.choice.id == "conduction/lucy-flux");
  BOOST_TEST(c.count("error").worse == 1);
  BOOST_TEST(c.count("error").same == 0);
  Compared const mended(results_of({Ladder{.last_status = "unstable"}}), results_of({Ladder{}}));
  BOOST_TEST(mended.changes.list.front().direction == "better");
}

BOOST_AUTO_TEST_CASE(ladders_are_compared_at_their_finest_common_level_and_only_equal_ones_by_order) {
  Compared const c(results_of({Ladder{.resolutions = {25, 50}}}),
                   results_of({Ladder{.resolutions = {25, 50, 100}, .last_status = "unstable"}}));
  BOOST_TEST(c.count("status").same == 1);
  BOOST_TEST(c.count("error").same == 1);
  BOOST_TEST(c.count("order").same == 0);
  BOOST_TEST(c.count("verdict").changed == 0);
}

BOOST_AUTO_TEST_CASE(another_smoothing_length_or_another_seed_is_another_scene) {
  Results wider = results_of({Ladder{}});
  for (RunRecord& run : wider.runs) run.smoothing_length *= 1.5;
  BOOST_TEST(Compared(results_of({Ladder{}}), wider).changes.not_comparable.size() == 1u);
  BOOST_TEST(Compared(results_of({Ladder{.first_seed = 1}}), results_of({Ladder{.first_seed = 2}}))
                 .changes.not_comparable.size() == 1u);
}

BOOST_AUTO_TEST_CASE(means_over_other_seeds_differ_by_their_scatter) {
  auto const with = [](std::uint64_t first, double error) {
    return results_of({Ladder{.error = error, .seeds = 3, .first_seed = first}});
  };
  // The errors scatter by 0.1 about 1.1: with 3.87 degrees of freedom 2.81 hypot(0.1, 0.12) / sqrt(3), 23%
  // of 1.1.
  Compared const near(with(1, 1e-3), with(7, 1.2e-3));
  BOOST_TEST(near.count("error").within_noise == 1);
  BOOST_TEST(near.count("wall flux").same == 0);
  BOOST_TEST(Compared(with(1, 1e-3), with(7, 1.3e-3)).count("error").worse == 1);
  // The same particles have none.
  BOOST_TEST(Compared(with(1, 1e-3), with(1, 1.1e-3)).count("error").worse == 1);
}

BOOST_AUTO_TEST_CASE(two_seeds_tell_little_of_their_scatter) {
  auto const with = [](std::uint64_t first, double error) {
    return results_of({Ladder{.error = error, .order = 0.0, .seeds = 2, .first_seed = first}});
  };
  Compared const c(with(1, 1e-3), with(7, 2e-3));
  BOOST_REQUIRE(!c.changes.list.empty());
  BOOST_TEST(c.changes.list.front().measure == "error");
  // Of 1 and 1.1 the variance is 0.005. By Welch 25/17 degrees of freedom, whose quantile is 6.18811.
  double const expected = 6.18811 * 1e-3 * std::sqrt((0.005 + 4.0 * 0.005) / 2.0);
  double const time_errors = 0.002 * 2.1e-3;
  BOOST_TEST(std::abs(*c.changes.list.front().noise - time_errors - expected) < 1e-5 * expected);
}

BOOST_AUTO_TEST_CASE(an_order_changes_when_it_leaves_the_interval) {
  auto const judged = [](double order, double half_width, std::string const& verdict) {
    Results results = results_of({Ladder{}});
    for (OrderEntry& entry : results.series.at(0).orders) {
      entry.observed.order = order;
      entry.observed.lower = order - half_width;
      entry.observed.upper = order + half_width;
      entry.observed.verdict = verdict;
    }
    return results;
  };
  Compared const within(judged(1.0, 0.3, "asymptotic"), judged(0.8, 0.3, "asymptotic"));
  BOOST_TEST(within.count("order").within_noise == 1);
  Compared const steeper(judged(1.0, 0.1, "asymptotic"), judged(2.0, 0.1, "asymptotic"));
  BOOST_TEST(steeper.count("order").better == 1);
  Compared const flat(judged(1.0, 0.1, "asymptotic"), judged(0.01, 0.1, "floored"));
  BOOST_TEST(flat.count("verdict").changed == 1);
  BOOST_TEST(flat.count("order").worse == 1);
}

BOOST_AUTO_TEST_CASE(what_adaptive_steps_leave_in_a_drift_is_noise_until_it_grows_beyond_threefold) {
  auto const left = [](double before, double after) {
    return Compared(results_of({Ladder{.drift = before}}), results_of({Ladder{.drift = after}}));
  };
  BOOST_TEST(left(1e-5, 2.9e-5).count("energy drift").within_noise == 1);
  BOOST_TEST(left(1e-5, 3.1e-5).count("energy drift").worse == 1);
  BOOST_TEST(left(0.0, 1.9e-6).count("energy drift").within_noise == 1);  // the tolerances, 1e-6 each
  BOOST_TEST(left(0.0, 2.1e-6).count("energy drift").worse == 1);
  // What pairs create is the formulation's.
  auto const created = [](double amount) {
    return results_of({Ladder{.drift = amount + 1e-8, .pair_drift = amount}});
  };
  BOOST_TEST(Compared(created(0.1), created(0.09)).count("energy drift").better == 1);
  // Rounding, over a hundred steps.
  BOOST_TEST(left(1e-16, 1e-14).count("energy drift").within_noise == 1);
}

BOOST_AUTO_TEST_CASE(a_wall_flux_is_compared_and_takes_part_of_the_temperature_s_time_error) {
  auto const flux = [](double value) { return results_of({Ladder{.wall_flux = value}}); };
  BOOST_TEST(Compared(flux(0.01), flux(0.010019)).count("wall flux").within_noise == 1);
  BOOST_TEST(Compared(flux(0.01), flux(0.0101)).count("wall flux").worse == 1);
  BOOST_TEST(Compared(flux(0.01), flux(-0.005)).count("wall flux").better == 1);
}

BOOST_AUTO_TEST_CASE(series_of_one_document_alone_are_named) {
  Compared const c(results_of({Ladder{}, Ladder{.formulation = "conduction/lucy-flux"}}),
                   results_of({Ladder{}, Ladder{.formulation = "conduction/campbell-flux"}}));
  BOOST_TEST(c.changes.in_both == 1);
  BOOST_REQUIRE(c.changes.only_before.size() == 1u);
  BOOST_REQUIRE(c.changes.only_after.size() == 1u);
  BOOST_TEST(c.changes.only_before[0].find("lucy-flux") != std::string::npos);
  BOOST_TEST(c.changes.only_after[0].find("campbell-flux") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_parameter_that_only_one_version_knows_does_not_part_series) {
  Results newer = results_of({Ladder{}});
  for (RunRecord& run : newer.runs) run.parameters["angle"] = 0.0;
  newer.series = build_series(newer.runs);
  BOOST_TEST(Compared(results_of({Ladder{}}), newer).changes.in_both == 1);
  // Where that leaves a choice there is no telling which is meant.
  Results choice = newer;
  for (RunRecord run : newer.runs) {
    run.parameters["angle"] = 1.0;
    choice.runs.push_back(run);
  }
  choice.series = build_series(choice.runs);
  BOOST_TEST(Compared(choice, results_of({Ladder{}})).changes.in_both == 0);
  Results hotter = results_of({Ladder{}});
  for (RunRecord& run : hotter.runs) run.parameters["final_time"] = 0.1;
  hotter.series = build_series(hotter.runs);
  BOOST_TEST(Compared(results_of({Ladder{}}), hotter).changes.in_both == 0);
}

/// A series per angle, without the parameter where empty.
Results with_angles(std::vector<Number> const& angles) {
  Results results;
  for (Number const& angle : angles) {
    for (RunRecord run : results_of({Ladder{}}).runs) {
      if (angle) run.parameters["angle"] = *angle;
      results.runs.push_back(run);
    }
  }
  results.series = build_series(results.runs);
  return results;
}

BOOST_AUTO_TEST_CASE(an_inexact_partner_is_neither_a_choice_nor_taken_from_an_exact_one) {
  // Either of the later ones might be the earlier one.
  Compared const choice(with_angles({{}}), with_angles({0.0, 1.0}));
  BOOST_TEST(choice.changes.in_both == 0);
  BOOST_TEST(choice.changes.only_before.size() == 1u);
  BOOST_TEST(choice.changes.only_after.size() == 2u);
  // The one without an angle comes last, and is the same.
  Results const reversed = with_angles({0.0, {}});
  BOOST_REQUIRE(reversed.series.front().parameters.contains("angle"));
  Compared const c(with_angles({{}}), reversed);
  BOOST_TEST(c.changes.in_both == 1);
  BOOST_REQUIRE(c.changes.only_after.size() == 1u);
  BOOST_TEST(c.changes.only_after[0].find("angle") != std::string::npos, c.changes.only_after[0]);
}

BOOST_AUTO_TEST_CASE(the_same_build_and_machine_is_told_by_the_context) {
  Results before = results_of({Ladder{}});
  before.context = {"1", "abc", "gcc", "-O3", "cpu", "today", 2};
  Results after = before;
  BOOST_TEST(Compared(before, after).changes.same_machine);
  after.context.processor = "another";
  BOOST_TEST(!Compared(before, after).changes.same_machine);
  after = before;
  for (char const* commit : {"abc-dirty", "unknown"}) {  // may be any source
    before.context.commit = after.context.commit = commit;
    BOOST_TEST(!Compared(before, after).changes.same_machine);
  }
}

BOOST_AUTO_TEST_CASE(only_the_same_runs_that_load_did_not_end_should_have_repeated) {
  auto const not_repeated = [](Results const& before, Results const& after) {
    return Compared(before, after).changes.not_repeated;
  };
  BOOST_TEST(not_repeated(results_of({Ladder{}}), results_of({Ladder{}})) == 0);
  BOOST_TEST(not_repeated(results_of({Ladder{}}), results_of({Ladder{.error = 1.0000001e-3}})) > 0);
  BOOST_TEST(not_repeated(results_of({Ladder{}}), results_of({Ladder{.last_status = "unstable"}})) == 1);
  BOOST_TEST(not_repeated(results_of({Ladder{}}), results_of({Ladder{.last_status = "timed-out"}})) == 0);
  Results const seeds = results_of({Ladder{.seeds = 3, .first_seed = 1}});
  BOOST_TEST(not_repeated(seeds, results_of({Ladder{.error = 2e-3, .seeds = 3, .first_seed = 7}})) == 0);
  // Other seeds at another level move the order.
  Results coarse = results_of({Ladder{.error = 2e-3, .seeds = 3, .first_seed = 1}});
  for (RunRecord& run : coarse.runs) {
    if (run.resolution == 25) run.discretisation.layout.seed += 6;
  }
  coarse.series = build_series(coarse.runs);
  BOOST_TEST(not_repeated(seeds, coarse) == 0);
}

/// A bisection on a linear scale that ends between two values.
Results limits(double held, double failed, double from = 0.0, double to = 1.0) {
  Envelope envelope;
  envelope.case_id = "conduction/slab-dirichlet";
  envelope.formulation.id = envelope.label = "conduction/brookshaw";
  envelope.parameter = "amplitude";
  envelope.held = held;
  envelope.failed = failed;
  envelope.status = "unstable";
  envelope.points = {{to, "unstable"}, {from, "ok"}};
  Results results;
  results.envelopes = {envelope};
  return results;
}

BOOST_AUTO_TEST_CASE(an_envelope_changes_by_more_than_its_bracket_and_towards_the_harder_is_better) {
  BOOST_TEST(Compared(limits(0.5, 0.6), limits(0.55, 0.65)).count("held to").within_noise == 1);
  BOOST_TEST(Compared(limits(0.5, 0.6), limits(0.8, 0.9)).count("held to").better == 1);
  BOOST_TEST(Compared(limits(0.5, 0.4, 1.0, 0.0), limits(0.8, 0.7, 1.0, 0.0)).count("held to").worse == 1);
  Results holds = limits(1.0, 0.0);
  holds.envelopes[0].failed.reset();
  holds.envelopes[0].status = "ok";
  holds.envelopes[0].points = {{1.0, "ok"}};
  Compared const c(holds, limits(0.5, 0.6));
  BOOST_TEST(c.count("how it fails").worse == 1);
  BOOST_TEST(c.count("held to").worse == 1);
}

BOOST_AUTO_TEST_CASE(envelopes_that_were_asked_for_other_ranges_do_not_compare) {
  for (Results const& other : {limits(0.5, 0.6, 0.0, 2.0), limits(0.5, 0.6, 0.25, 1.0)}) {
    Compared const c(limits(0.5, 0.6), other);
    BOOST_TEST(c.changes.not_comparable.size() == 1u);
    BOOST_TEST(c.changes.counts.empty());
  }
}

BOOST_AUTO_TEST_CASE(envelopes_should_repeat_unless_they_were_bisected_otherwise_or_load_ended_a_run) {
  auto const not_repeated = [](Results const& after) {
    return Compared(limits(0.5, 0.6), after).changes.not_repeated;
  };
  BOOST_TEST(not_repeated(limits(0.7, 0.8)) == 1);
  Results finer = limits(0.55, 0.6);
  finer.envelopes[0].points.push_back({0.55, "ok"});
  BOOST_TEST(not_repeated(finer) == 0);
  Results late = limits(0.5, 0.6);
  late.envelopes[0].status = late.envelopes[0].points[0].status = "timed-out";
  BOOST_TEST(not_repeated(late) == 0);
}

BOOST_AUTO_TEST_CASE(of_many_ladders_that_only_one_has_five_are_named_and_the_others_counted) {
  for (std::size_t const more : {0u, 2u}) {
    std::vector<Ladder> ladders{Ladder{}};
    for (std::size_t k = 0; k < 5 + more; ++k) ladders.push_back({.formulation = "conduction/own-" + std::to_string(k)});
    Compared const c(results_of({Ladder{}}), results_of(ladders));
    BOOST_TEST(c.changes.only_after.size() == 5 + more);
    std::string const text = changes_text(c.changes, CompareOptions{});
    BOOST_TEST(text.find(std::to_string(5 + more) + " only in after:") != std::string::npos, text);
    BOOST_TEST(text.find("own-4") != std::string::npos, text);
    BOOST_TEST((text.find("own-5") != std::string::npos) == false, text);
    BOOST_TEST((text.find("  and 2 more\n") != std::string::npos) == (more > 0), text);
    BOOST_TEST(text.find("and 0 more") == std::string::npos, text);
  }
}

BOOST_AUTO_TEST_CASE(every_document_is_compared_with_the_first) {
  std::vector<NamedResults> const documents{{"a", results_of({Ladder{}})},
                                            {"b", results_of({Ladder{.error = 2e-3}})},
                                            {"c", results_of({Ladder{.error = 2e-3}})}};
  auto const all = changes_of(documents, "all", "");
  BOOST_REQUIRE(all.size() == 2u);
  BOOST_TEST(all[1].before->name == "a");
  BOOST_TEST(all[1].after->name == "c");
  BOOST_TEST(!all[1].list.empty());
}

BOOST_AUTO_TEST_SUITE_END()
