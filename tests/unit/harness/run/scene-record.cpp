// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "tests/support/runs.hpp"

// A scene pays only for what it needs, and says what it paid for.
BOOST_AUTO_TEST_SUITE(harness_run_scene_record)

using namespace sphverify;
using namespace sphverify::tests;

MeasureSet const everything{Measure::error, Measure::conservation, Measure::cost, Measure::stability};

SceneRecord scene_of(RunChoice const& choice) {
  RunRecord const record = run(choice, everything);
  BOOST_TEST_REQUIRE(record.status == "ok", record.reason);
  return record.scene;
}

bool has(SceneRecord const& scene, std::string const& field) {
  return std::find(scene.fields.begin(), scene.fields.end(), field) != scene.fields.end();
}

std::uint64_t times(SceneRecord const& scene, std::string const& pass) {
  auto const found = scene.passes.find(pass);
  return found == scene.passes.end() ? 0 : found->second;
}

BOOST_AUTO_TEST_CASE(conduction_allocates_just_the_fields_of_its_scheme) {
  std::vector<std::string> const one_pass{"position",    "mass",         "density",
                                          "temperature", "conductivity", "heating"};
  std::vector<std::string> const two_pass{"position",     "mass", "density", "temperature",
                                          "conductivity", "flux", "heating"};
  for (std::string const& formulation : conduction_schemes()) {
    for (bool const walls : {true, false}) {
      auto const& expected = formulation == "conduction/brookshaw" ? one_pass : two_pass;
      SceneRecord const scene = scene_of({.formulation = formulation, .walls = walls});
      BOOST_TEST(scene.fields == expected, boost::test_tools::per_element());
      for (char const* field : {"velocity", "pressure", "internal_energy", "acceleration"})
        BOOST_TEST(!has(scene, field));
    }
  }
}

BOOST_AUTO_TEST_CASE(frozen_particles_are_searched_and_weighed_once_however_many_rates_are_evaluated) {
  for (std::string const& formulation : conduction_schemes()) {
    for (bool const walls : {true, false}) {
      SceneRecord const scene = scene_of({.formulation = formulation, .walls = walls});
      for (char const* pass : {"layout", "neighbour-search"}) BOOST_TEST(times(scene, pass) == 1u);
      BOOST_TEST(times(scene, "conductances") == (formulation == "conduction/brookshaw" ? 1u : 0u));
      BOOST_TEST(times(scene, "wall-contacts") == (walls ? 1u : 0u));
      BOOST_TEST(times(scene, formulation) > 100u);
    }
  }
}

BOOST_AUTO_TEST_CASE(only_two_pass_forms_run_a_flux_pass_and_as_often_as_the_rate) {
  for (std::string const& formulation : conduction_schemes()) {
    SceneRecord const scene = scene_of({.formulation = formulation});
    std::uint64_t const expected = formulation == "conduction/brookshaw" ? 0 : times(scene, formulation);
    BOOST_TEST(times(scene, "flux") == expected);
  }
}

BOOST_AUTO_TEST_CASE(a_scene_runs_no_other_pass_than_these) {
  std::vector<std::string> const expected{"conductances", "conduction/brookshaw", "conductivity", "layout",
                                          "neighbour-search"};
  SceneRecord const scene = scene_of({.walls = false});
  std::vector<std::string> found;
  for (auto const& [pass, count] : scene.passes) found.push_back(pass);
  BOOST_TEST(found == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_conductivity_that_does_not_depend_on_temperature_is_set_once) {
  BOOST_TEST(times(scene_of({}), "conductivity") == 1u);
  BOOST_TEST(times(scene_of({.scene_case = "conduction/manufactured"}), "conductivity") > 100u);
  BOOST_TEST(times(scene_of({.scene_case = "conduction/manufactured"}), "conductances") == 0u);
}

BOOST_AUTO_TEST_CASE(densities_are_summed_only_where_the_study_says_so_and_once) {
  SceneRecord const given = scene_of({});
  BOOST_TEST(times(given, "density-summation") == 0u);
  BOOST_TEST(times(given, "density-normalisation") == 0u);
  SceneRecord const summed = scene_of({.discretisation = with_density("summation")});
  BOOST_TEST(times(summed, "density-summation") == 1u);
  BOOST_TEST(times(summed, "density-normalisation") == 0u);
  SceneRecord const normalised = scene_of({.discretisation = with_density("normalised")});
  BOOST_TEST(times(normalised, "density-summation") == 1u);
  BOOST_TEST(times(normalised, "density-normalisation") == 1u);
}

BOOST_AUTO_TEST_CASE(a_source_is_evaluated_only_where_the_case_has_one) {
  BOOST_TEST(times(scene_of({}), "source") == 0u);
  BOOST_TEST(times(scene_of({.scene_case = "conduction/manufactured"}), "source") > 100u);
}

BOOST_AUTO_TEST_CASE(operator_cases_evaluate_one_rate_on_the_fields_of_their_scheme) {
  SceneRecord const momentum =
      scene_of({.scene_case = "operator/sine", .formulation = "momentum/p-rho2", .resolution = 20});
  std::vector<std::string> const expected{"position", "mass", "density", "pressure", "acceleration"};
  BOOST_TEST(momentum.fields == expected, boost::test_tools::per_element());
  BOOST_TEST(times(momentum, "conductivity") == 0u);
  BOOST_TEST(times(momentum, "neighbour-search") == 1u);
  SceneRecord const work =
      scene_of({.scene_case = "operator/sine", .formulation = "work/total-energy", .resolution = 20});
  BOOST_TEST(has(work, "velocity"));
  BOOST_TEST(!has(work, "temperature"));
}

BOOST_AUTO_TEST_CASE(the_cost_counts_the_pairs_of_both_passes) {
  auto const per_evaluation = [](char const* formulation) {
    RunRecord const record = run({.formulation = formulation}, {Measure::cost});
    return static_cast<double>(record.cost->pair_interactions) /
           static_cast<double>(record.cost->rate_evaluations);
  };
  // At h/dx = 1.2 a particle sees two on each side, but for the two nearest the walls: 25 * 4 - 2 * 3.
  BOOST_TEST(per_evaluation("conduction/brookshaw") == 94.0);
  BOOST_TEST(per_evaluation("conduction/campbell-flux") == 188.0);
}

BOOST_AUTO_TEST_SUITE_END()
