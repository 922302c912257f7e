// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/gate/reference_accuracy.hpp"

#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "cases/support/case.hpp"
#include "harness/gate/judge.hpp"
#include "tests/unit/harness/gate/small_results.hpp"

BOOST_AUTO_TEST_SUITE(harness_gate_reference_accuracy)

using namespace sphverify;
using namespace sphverify::tests;

BOOST_AUTO_TEST_CASE(every_case_states_an_accuracy) {
  for (Case const& one : all_cases()) {
    auto const accuracy = reference_accuracy(one.info.id, {});
    BOOST_TEST_REQUIRE(accuracy.has_value(), one.info.id);
    BOOST_TEST((accuracy->value >= 0.0 && std::isfinite(accuracy->value)), one.info.id);
    BOOST_TEST(accuracy->relative == moves(one.info.kind), one.info.id);
  }
}

BOOST_AUTO_TEST_CASE(the_accuracy_is_that_of_the_parameters) {
  // The nonlinear terms that the standing wave lacks grow as the cube of its amplitude.
  double const small = reference_accuracy("hydro/acoustic", {{"amplitude", 1e-4}})->value;
  double const large = reference_accuracy("hydro/acoustic", {{"amplitude", 1e-3}})->value;
  BOOST_TEST(large == 1000.0 * small, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(an_unknown_case_or_one_that_refuses_its_parameters_states_none) {
  BOOST_TEST(!reference_accuracy("hydro/nowhere", {}).has_value());
  BOOST_TEST(!reference_accuracy("conduction/marshak", {{"exponent", -1.0}}).has_value());
  BOOST_TEST(!reference_accuracy("conduction/marshak", {{"exponent", "three"}}).has_value());
}

std::string refusal(std::string const& gate, Results const& results) {
  return complaint([&] { judge(gates_of(gate), results, {}); });
}

BOOST_AUTO_TEST_CASE(a_limit_below_the_accuracy_is_refused) {
  Results const results = results_of({run_at(25, 1e-3)});  // the exact field's l2 norm is 2
  double const smallest = reference_accuracy("conduction/slab-dirichlet", {})->value;
  BOOST_TEST_REQUIRE(smallest > 0.0);
  auto const error = [](std::string const& key, double limit) {
    return fmt::format(R"("measure": "error", "{}": {})", key, limit);
  };
  for (std::string const key : {"maximum", "minimum", "equals"}) {
    std::string const said = refusal(error(key, 0.9 * smallest), results);
    BOOST_TEST(says(said, "gates.json: gates[0]." + key + ": found "), said);
    BOOST_TEST(says(said, "the reference of conduction/slab-dirichlet is no more accurate"), said);
    BOOST_TEST(refusal(error(key, 1.1 * smallest), results) == "");
  }
  std::string const relative = R"(, "relative": true)";
  BOOST_TEST(refusal(error("maximum", 0.9 * 0.5 * smallest) + relative, results) != "");
  BOOST_TEST(refusal(error("maximum", 1.1 * 0.5 * smallest) + relative, results) == "");
}

BOOST_AUTO_TEST_CASE(a_skill_is_held_to_the_accuracy_over_the_error_of_doing_nothing) {
  RunRecord run = run_at(25, 1e-3);
  run.errors["temperature"]["all"].initial = NormSet{1.0, 4.0, 8.0};
  Results const results = results_of({run});
  double const smallest = reference_accuracy("conduction/slab-dirichlet", {})->value / 4.0;
  auto const refused = [&](double limit) {
    return !refusal(fmt::format(R"("measure": "skill", "maximum": {})", limit), results).empty();
  };
  BOOST_TEST(refused(0.9 * smallest));
  BOOST_TEST(!refused(1.1 * smallest));
}

BOOST_AUTO_TEST_CASE(that_of_a_gas_is_a_part_of_its_fields_and_of_its_speed_of_sound) {
  RunRecord run = run_at(25, 1e-3);
  run.case_id = "hydro/acoustic";
  run.parameters = {{"amplitude", 1e-4}};
  run.errors.clear();
  run.errors["pressure"]["all"] = {{1.0, 1.0, 1.0}, {1e6, 1e6, 8e6}, 0.0};
  run.errors["density"]["all"] = {{1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}, 0.0};
  run.errors["velocity"]["all"] = {{1.0, 1.0, 1.0}, {1e-9, 1e-9, 1e-9}, 0.0};
  Results const results = results_of({run});
  double const accuracy = reference_accuracy("hydro/acoustic", run.parameters)->value;
  auto const refused = [&](std::string const& field, double limit) {
    return !refusal(fmt::format(R"("measure": "error", "field": "{}", "maximum": {})", field, limit), results)
                .empty();
  };
  BOOST_TEST(refused("pressure", 0.9 * 8e6 * accuracy));
  BOOST_TEST(!refused("pressure", 1.1 * 8e6 * accuracy));
  BOOST_TEST(refused("velocity", 0.9 * 4e3 * accuracy));
  BOOST_TEST(!refused("velocity", 1.1 * 4e3 * accuracy));
}

BOOST_AUTO_TEST_CASE(fluxes_and_targets_are_held_to_it_too_and_budgets_are_not) {
  RunRecord run = run_at(25, 1e-3);
  run.wall_flux = {{1.0, 1.0, 0.0, 2.0}};
  run.conservation["energy"] = {};
  double const part = reference_accuracy(run.case_id, {})->value / 4.0;  // of the largest exact temperature
  Results const results = results_of({run});
  auto const flux = [&](double limit, char const* relative) {
    return refusal(fmt::format(R"("measure": "wall_flux", "maximum": {}, "relative": {})", limit, relative),
                   results);
  };
  BOOST_TEST(says(flux(0.9 * part, "true"), "gates[0].maximum"));
  BOOST_TEST(flux(1.1 * part, "true") == "");
  BOOST_TEST(flux(0.9 * 2.0 * part, "false") != "");
  BOOST_TEST(flux(1.1 * 2.0 * part, "false") == "");
  BOOST_TEST(refusal(R"("measure": "conservation", "maximum": 1e-20)", results) == "");

  // Terms that the standing wave lacks: a tenth of a percent of it is too much to ask of a loud one.
  auto const loud = [](std::string const& id) {
    RunRecord wave = timed(run_at(25, 1e-6, id), 1.0);
    wave.case_id = "hydro/acoustic";
    wave.parameters = {{"amplitude", 0.1}};
    wave.errors["velocity"] = wave.errors["temperature"];
    return wave;
  };
  std::string const target =
      R"("measure": "time_to_error", "maximum": 9, "field": "velocity", "target": 0.001,
                                "relative_to": "momentum/sqrt-p")";
  Results const waves = results_of({loud("momentum/p-rho2"), loud("momentum/sqrt-p")});
  BOOST_TEST(says(refusal(target, waves), "gates[0].target: found 0.001, expected at least"));
}

BOOST_AUTO_TEST_SUITE_END()
