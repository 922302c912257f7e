// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/gate/select.hpp"

#include <boost/test/unit_test.hpp>
#include <map>
#include <string>

#include "reports/json/results_json.hpp"
#include "tests/unit/harness/gate/small_results.hpp"

BOOST_AUTO_TEST_SUITE(harness_gate_select)

using namespace sphverify;
using namespace sphverify::tests;

Select select_of(std::string const& text) {
  return gate_of(R"("measure": "status", "equals": "ok", "select": )" + text).select;
}

bool takes(std::string const& select, RunRecord const& run) { return matches(select_of(select), run); }

RunRecord gas() {
  RunRecord run = run_at(50, 1e-3);
  run.case_id = "hydro/riemann";
  run.parameters = {{"preset", "sod"}, {"gamma", 1.4}, {"left", std::vector<double>{1.0, 0.0, 1.0}}};
  run.formulation = {"momentum/p-rho2", "work/total-energy", "conduction/brookshaw", true};
  run.label = "gas";
  run.discretisation.density = "continuity";
  run.discretisation.viscosity = {1.0, 2.0};
  run.discretisation.smoothing_ratio = 1.5;
  run.smoothing_exponent = 0.5;
  return seeded(run, 7);
}

BOOST_AUTO_TEST_CASE(an_empty_selection_takes_all_with_walls) {
  RunRecord run = gas();
  BOOST_TEST(takes("{}", run));
  run.formulation.walls = false;
  BOOST_TEST(!takes("{}", run));
  BOOST_TEST(takes(R"({"walls": "off"})", run));
  BOOST_TEST(takes(R"({"walls": ["on", "off"]})", run));
  BOOST_TEST(takes(R"({"formulation": {"id": "momentum/p-rho2", "walls": "off"}})", run));
  BOOST_TEST(!takes(R"({"formulation": "momentum/p-rho2"})", run));
}

BOOST_AUTO_TEST_CASE(each_key_takes_what_it_names_and_leaves_the_rest) {
  struct {
    char const *takes, *leaves;
  } const pairs[] = {
      {R"({"case": "hydro/riemann"})", R"({"case": "hydro/noh"})"},
      {R"({"case": ["hydro/noh", "hydro/riemann"]})", R"({"case": ["hydro/noh"]})"},
      {R"({"case": {"id": "hydro/riemann", "parameters": {"gamma": 1.4, "left": [1, 0, 1]}}})",
       R"({"case": {"id": "hydro/riemann", "parameters": {"gamma": 1.5}}})"},
      {R"({"parameters": {"preset": "sod"}})", R"({"parameters": {"preset": "leblanc"}})"},
      {R"({"parameters": {}})", R"({"parameters": {"degree": 0}})"},
      {R"({"formulation": "momentum/p-rho2"})", R"({"formulation": "momentum/sqrt-p"})"},
      {R"({"formulation": {"id": "momentum/p-rho2", "work": "work/total-energy"}})",
       R"({"formulation": {"id": "momentum/p-rho2", "work": "work/internal-energy"}})"},
      {R"({"formulation": {"id": "momentum/p-rho2", "conduction": "conduction/brookshaw"}})",
       R"({"formulation": {"id": "momentum/p-rho2", "conduction": null}})"},
      {R"({"discretisation": {"density": ["given", "continuity"]}})",
       R"({"discretisation": {"density": "given"}})"},
      {R"({"discretisation": {"layout": "jittered"}})", R"({"discretisation": {"layout": "lattice"}})"},
      {R"({"discretisation": {"layout": {"id": "jittered", "amplitude": 0.1}}})",
       R"({"discretisation": {"layout": {"id": "jittered", "amplitude": 0.2}}})"},
      {R"({"discretisation": {"layout": {"id": "jittered", "seed": 7}}})",
       R"({"discretisation": {"layout": {"id": "jittered", "seed": 8}}})"},
      {R"({"discretisation": {"viscosity": {"alpha": 1, "beta": 2}}})",
       R"({"discretisation": {"viscosity": "off"}})"},
      {R"({"discretisation": {"smoothing_ratio": 1.5}})", R"({"discretisation": {"smoothing_ratio": 1.2}})"},
      {R"({"discretisation": {"face_weight": "exact"}})",
       R"({"discretisation": {"face_weight": "campbell"}})"},
      {R"({"smoothing_exponent": 0.5})", R"({"smoothing_exponent": 0})"},
      {R"({"resolution": [25, 50]})", R"({"resolution": 25})"},
  };
  for (auto const& pair : pairs) {
    BOOST_TEST(takes(pair.takes, gas()), pair.takes);
    BOOST_TEST(!takes(pair.leaves, gas()), pair.leaves);
  }
}

// Every key that a document's discretisation has: a new one must be put here.
BOOST_AUTO_TEST_CASE(each_key_of_a_discretisation_takes_its_own_value_and_leaves_another) {
  std::map<std::string, std::string> const others{
      {"kernel", R"("quintic-spline")"}, {"density", R"("given")"},        {"smoothing_ratio", "1.2"},
      {"layout", R"("lattice")"},        {"face_weight", R"("campbell")"}, {"closure", R"("one-sided")"},
      {"integrator", R"("bdf")"},        {"smoothing", R"("adaptive")"},   {"wall_motion", R"("mass")"},
      {"viscosity", R"("off")"}};
  for (auto const& [key, value] : to_json(gas()).at("discretisation").items()) {
    BOOST_TEST_CONTEXT(key) {
      BOOST_TEST_REQUIRE(others.contains(key), "which other value may it have?");
      auto const select = [&](std::string const& text) {
        return R"({"discretisation": {")" + key + R"(": )" + text + "}}";
      };
      BOOST_TEST(takes(select(value.dump()), gas()));
      BOOST_TEST(!takes(select(others.at(key)), gas()));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_series_is_selected_by_the_same_keys) {
  Results const results = results_of({gas()});
  BOOST_TEST(
      matches(select_of(R"({"case": "hydro/riemann", "smoothing_exponent": 0.5})"), results.series[0]));
  BOOST_TEST(!matches(select_of(R"({"discretisation": {"layout": "lattice"}})"), results.series[0]));
}

BOOST_AUTO_TEST_CASE(why_nothing_was_selected_is_said_by_the_first_key_that_nothing_meets) {
  Results const results = results_of({gas(), run_at(25, 1.0)});
  Gate gate;
  auto const why = [&](std::string const& select) {
    gate.select = select_of(select);
    return why_empty(gate, results);
  };
  BOOST_TEST(why(R"({"case": "hydro/noh"})") ==
             "no run matches 'case'; the runs have conduction/slab-dirichlet, hydro/riemann");
  BOOST_TEST(why(R"({"resolution": 99})") == "no run matches 'resolution'; the runs have 25, 50");
  BOOST_TEST(why(R"({"case": "hydro/riemann", "resolution": 25})") ==
             "no run that matches 'case' also matches 'resolution'; those runs have 50");
  BOOST_TEST(why_empty(Gate(), Results()) == "the results hold no run");
}

BOOST_AUTO_TEST_CASE(a_name_that_no_run_has_is_answered_with_the_nearest_one_that_there_is) {
  Results const results = results_of({gas(), run_at(25, 1.0)});
  auto const why = [&](std::string const& select) {
    Gate gate;
    gate.select = select_of(select);
    return why_empty(gate, results);
  };
  for (auto const& [select, meant] :
       {std::pair{R"({"case": "hydro/rieman"})", "hydro/riemann"},
        std::pair{R"({"case": "riemann"})", "hydro/riemann"},
        std::pair{R"({"case": {"id": "hydro/riemann", "parameters": {"gama": 1.4}}})", "gamma"},
        std::pair{R"({"parameters": {"preset": "sodd"}})", "sod"},
        std::pair{R"({"formulation": "brookshaw"})", "conduction/brookshaw"},
        std::pair{R"({"formulation": ["momentum/p-rho3"]})", "momentum/p-rho2"},
        std::pair{R"({"formulation": {"id": "momentum/p-rho2", "work": "work/total-enrgy"}})",
                  "work/total-energy"},
        std::pair{R"({"formulation": {"id": "momentum/p-rho2", "conduction": "brookshw"}})",
                  "conduction/brookshaw"},
        std::pair{R"({"discretisation": {"layout": "jitered"}})", "jittered"},
        std::pair{R"({"discretisation": {"density": "continuty"}})", "continuity"},
        std::pair{R"({"discretisation": {"kernel": "cubic-splin"}})", "cubic-spline"}}) {
    BOOST_TEST(says(why(select), std::string("(did you mean '") + meant + "'?)"), why(select));
  }
  // What this program knows is not misspelt, but was not run; what is like nothing suggests nothing.
  for (char const* select :
       {R"({"case": "hydro/noh"})", R"({"formulation": "momentum/sqrt-p"})",
        R"({"case": "a/completely-different-thing"})", R"({"parameters": {"gamma": 9}})"})
    BOOST_TEST(!says(why(select), "did you mean"), why(select));
}

BOOST_AUTO_TEST_CASE(an_entry_of_a_list_that_matches_nothing_is_named) {
  Results const results = results_of({gas(), run_at(25, 1.0), run_at(50, 1.0)});
  auto const unmatched = [&](std::string const& select, std::string const& measure = "status") {
    std::string const limit =
        measure == "status" ? R"(, "equals": "ok", "select": )" : R"(, "maximum": 1, "select": )";
    return unmatched_entry(gate_of(R"("measure": ")" + measure + '"' + limit + select), results);
  };
  struct {
    std::string select, key, entry;
  } const lists[] = {
      {R"({"case": ["hydro/riemann", "hydro/rieman"]})", "case", "hydro/rieman"},
      {R"({"case": ["hydro/riemann", {"id": "hydro/riemann", "parameters": {"gamma": 9}}]})", "case",
       "hydro/riemann {\"gamma\":9}"},
      {R"({"formulation": ["conduction/brookshaw", "conduction/lucy-flux"]})", "formulation",
       "conduction/lucy-flux"},
      {R"({"formulation": ["conduction/brookshaw", {"id": "momentum/p-rho2", "work": "w"}]})", "formulation",
       "momentum/p-rho2 + w"},
      {R"({"walls": ["on", "off"]})", "walls", "off"},
      {R"({"discretisation": {"density": ["given", "sumation"]}})", "discretisation.density", "sumation"},
      {R"({"discretisation": {"smoothing_ratio": [1.5, 3]}})", "discretisation.smoothing_ratio", "3"},
      {R"({"discretisation": {"layout": ["lattice", {"id": "jittered", "amplitude": 0.2}]}})",
       "discretisation.layout", "jittered 0.2"},
      {R"({"discretisation": {"viscosity": ["off", {"alpha": 3, "beta": 4}]}})", "discretisation.viscosity",
       "{\"alpha\":3.0,\"beta\":4.0}"},
      {R"({"resolution": [25, 50, 99]})", "resolution", "99"},
      {R"({"smoothing_exponent": [0, 0.25]})", "smoothing_exponent", "0.25"}};
  for (auto const& one : lists) {
    std::string const said = unmatched(one.select);
    BOOST_TEST(said.rfind("'" + one.entry + "' in the list of '" + one.key + "' matches nothing: ", 0) == 0u,
               said);
  }
  for (char const* select :
       {R"({})", R"({"case": ["hydro/riemann", "conduction/slab-dirichlet"]})", R"({"resolution": [25, 50]})",
        R"({"discretisation": {"layout": ["lattice", "jittered"]}})", R"({"case": ["hydro/rieman"]})"})
    BOOST_TEST(unmatched(select) == "", select);
  // Alone it would do, beside the other keys it does not.
  BOOST_TEST(says(unmatched(R"({"case": ["hydro/riemann", "conduction/slab-dirichlet"], "resolution": 25})"),
                  "'hydro/riemann' in the list of 'case'"));
  BOOST_TEST(
      says(unmatched(R"({"case": ["conduction/slab-dirichlet", "hydro/noh"]})", "order"), "'hydro/noh'"));
  BOOST_TEST(
      says(unmatched(R"({"case": ["hydro/rieman", "hydro/riemann"]})"), "did you mean 'hydro/riemann'?"));
}

BOOST_AUTO_TEST_CASE(what_is_compared_to_may_stand_in_a_list) {
  Results const results = results_of({run_at(25, 1.0), run_at(25, 1.0, "conduction/lucy-flux")});
  BOOST_TEST(
      unmatched_entry(gate_of(R"("measure": "cost", "maximum": 1, "relative_to": "conduction/lucy-flux",
                                        "select": {"formulation": ["conduction/brookshaw", "conduction/lucy-flux"]})"),
                      results) == "");
}

BOOST_AUTO_TEST_CASE(a_gate_that_selects_only_what_it_compares_to_or_a_level_that_is_not_there_says_so) {
  Results const results = results_of({gas(), run_at(25, 1.0)});
  Gate gate;
  gate.select = select_of(R"({"case": "conduction/slab-dirichlet"})");
  gate.relative_to.id = run_at(25, 1.0).formulation.id;
  BOOST_TEST(why_empty(gate, results) == "it selects runs of " + gate.relative_to.id +
                                             " alone, which 'relative_to' names: nothing is left to compare");
  gate.relative_to.id.clear();
  gate.levels = LevelChoice::one;
  gate.resolution = 99;
  BOOST_TEST(why_empty(gate, results) == "no run that it selects has 'resolution' 99; they have 25");
}

BOOST_AUTO_TEST_SUITE_END()
