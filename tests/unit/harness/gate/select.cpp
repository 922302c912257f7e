#include "harness/gate/select.hpp"

#include <boost/test/unit_test.hpp>

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
