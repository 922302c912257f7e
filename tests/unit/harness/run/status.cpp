// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <boost/test/unit_test.hpp>

#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_run_status)

using namespace sphverify;
using namespace sphverify::tests;

/// Disordered particles on which campbell-flux has fast growing modes, and time for them to grow.
RunChoice const growing{.formulation = "conduction/campbell-flux",
                        .resolution = 50,
                        .discretisation = jittered_by(0.3, 6),
                        .parameters = {{"final_time", 1.0}}};

BOOST_AUTO_TEST_CASE(a_run_whose_modes_grow_is_unstable_with_a_reason_and_no_errors) {
  RunRecord const record = run(growing, {Measure::error, Measure::conservation, Measure::cost});
  BOOST_TEST(record.status == "unstable");
  BOOST_TEST(record.reason.find("temperature grew to") != std::string::npos, record.reason);
  BOOST_TEST(record.reason.find(", 100 times") != std::string::npos, record.reason);
  BOOST_TEST(record.errors.empty());
  BOOST_TEST(record.conservation.empty());
  BOOST_TEST(record.wall_flux.empty());
  BOOST_TEST(!record.cost.has_value());
  BOOST_TEST(!record.scene.fields.empty());
  BOOST_TEST(record.particles == 50u);
}

BOOST_AUTO_TEST_CASE(the_spectrum_of_an_unstable_run_shows_its_growing_modes) {
  RunRecord const record = run(growing, {Measure::error, Measure::stability});
  BOOST_TEST(record.status == "unstable");
  BOOST_TEST(record.stability->spectral_abscissa.value() > 0.0);
  BOOST_TEST(record.stability->growing_modes.value() > 0u);
  BOOST_TEST(!record.stability->largest_stable_step.has_value());
  RunChoice stable = growing;
  stable.formulation = "conduction/brookshaw";
  RunRecord const other = run(stable, {Measure::stability});
  BOOST_TEST(other.stability->growing_modes.value() == 0u);
  BOOST_TEST(other.stability->largest_stable_step.value() > 0.0);
}

BOOST_AUTO_TEST_CASE(brookshaw_is_ok_on_the_same_particles) {
  RunChoice choice = growing;
  choice.formulation = "conduction/brookshaw";
  RunRecord const record = run(choice);
  BOOST_TEST(record.status == "ok", record.reason);
  BOOST_TEST(record.reason == "");
  BOOST_TEST(record.errors.contains("temperature"));
}

BOOST_AUTO_TEST_CASE(a_run_out_of_time_is_timed_out_with_a_reason_and_no_errors) {
  RunRecord const record = run({.resolution = 100}, {Measure::error, Measure::cost}, 1e-9);
  BOOST_TEST(record.status == "timed-out");
  BOOST_TEST(record.reason.find("time budget") != std::string::npos, record.reason);
  BOOST_TEST(record.errors.empty());
  BOOST_TEST(run({}, {Measure::error}, 100.0).status == "ok");
}

BOOST_AUTO_TEST_CASE(a_square_root_of_a_negative_pressure_is_a_lost_positivity) {
  RunRecord const record = run({.scene_case = "operator/sine",
                                .formulation = "momentum/sqrt-p",
                                .resolution = 20,
                                .parameters = {{"offset", 0.0}}});
  BOOST_TEST(record.status == "positivity-lost");
  BOOST_TEST(!record.reason.empty());
  BOOST_TEST(record.errors.empty());
}

BOOST_AUTO_TEST_CASE(a_combination_that_makes_no_sense_is_invalid_with_a_reason) {
  // The support does not fit into the periodic axis.
  RunRecord const record =
      run({.scene_case = "conduction/manufactured", .resolution = 3, .parameters = {{"dimension", 2.0}}});
  BOOST_TEST(record.status == "invalid");
  BOOST_TEST(!record.reason.empty());
}

BOOST_AUTO_TEST_CASE(an_interrupted_run_is_no_result) {
  std::atomic<bool> const interrupted{true};
  RunOptions options;
  options.measure = {Measure::error};
  options.interrupted = &interrupted;
  BOOST_CHECK_THROW(execute(make_spec({}), options), Interrupted);
}

BOOST_AUTO_TEST_CASE(a_record_says_what_was_run) {
  RunRecord const record =
      run({.resolution = 20, .smoothing_ratio = 1.5, .walls = false, .discretisation = jittered_by(0.2, 9)});
  BOOST_TEST(record.case_id == "conduction/slab-dirichlet");
  BOOST_TEST(record.formulation.id == "conduction/brookshaw");
  BOOST_TEST(!record.formulation.walls);
  BOOST_TEST(record.resolution == 20);
  BOOST_TEST(record.particles == 20u);
  BOOST_TEST(record.spacing == 0.05);
  BOOST_TEST(record.smoothing_length == 1.5 * 0.05);
  BOOST_TEST(record.discretisation.layout.seed == 9u);
  BOOST_TEST(record.parameters.contains("final_time"));
}

BOOST_AUTO_TEST_CASE(only_what_is_asked_for_is_measured) {
  RunRecord const nothing = run({}, {});
  BOOST_TEST(nothing.errors.empty());
  BOOST_TEST(nothing.conservation.empty());
  BOOST_TEST((!nothing.cost && !nothing.stability && !nothing.profile && !nothing.history));
  BOOST_TEST(nothing.spectrum.empty());
  RunRecord const all = run({}, {Measure::error, Measure::conservation, Measure::cost, Measure::stability,
                                 Measure::profile, Measure::history, Measure::spectrum});
  BOOST_TEST((all.cost && all.stability && all.profile && all.history));
  BOOST_TEST(all.spectrum.size() == 25u);
  BOOST_TEST(all.profile->position.size() == 25u);
  BOOST_TEST(all.history->time.size() == all.history->energy.size());
  BOOST_TEST(all.history->time.back() == 0.05);
  Budget const& energy = all.conservation.at("energy");
  BOOST_TEST(std::abs(all.history->energy.back() - energy.final) < 1e-14);
  BOOST_TEST(std::abs(all.history->exchanged.back() - energy.exchanged) < 1e-14);
}

BOOST_AUTO_TEST_CASE(threads_change_nothing_but_the_round_off) {
  RunOptions options;
  options.measure = {Measure::error};
  RunRecord const one = execute(make_spec({}), options);
  options.threads = 2;
  RunRecord const two = execute(make_spec({}), options);
  BOOST_TEST(
      two.errors.at("temperature").at("all").error.l2 == one.errors.at("temperature").at("all").error.l2,
      boost::test_tools::tolerance(1e-8));
}

BOOST_AUTO_TEST_CASE(the_smallest_face_weight_is_reported_where_it_may_be_negative) {
  BOOST_TEST(!run({}).smallest_face_weight.has_value());
  RunRecord const balanced = run({.discretisation = weighted("balanced")});
  BOOST_TEST(balanced.smallest_face_weight->value() > 0.0);
  RunRecord const off = run({.walls = false, .discretisation = weighted("balanced")});
  BOOST_TEST(off.smallest_face_weight.has_value());
  BOOST_TEST(!off.smallest_face_weight->has_value());
}

BOOST_AUTO_TEST_SUITE_END()
