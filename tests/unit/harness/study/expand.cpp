#include "harness/study/expand.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <set>

#include "reports/json/results_json.hpp"

BOOST_AUTO_TEST_SUITE(harness_study_expand)

using namespace sphverify;
using boost::test_tools::tolerance;

Expansion expansion(std::string const& text) {
  Json document = Json::parse(text);
  document["schema"] = "sphverify-study/1";
  document["name"] = "test";
  return expand(read_study(Node(document, "study.json")));
}

BOOST_AUTO_TEST_CASE(every_combination_is_one_run_in_a_fixed_order) {
  Expansion const e = expansion(R"({
    "cases": ["conduction/slab-dirichlet", "conduction/slab-insulated"],
    "formulations": ["conduction/brookshaw", "conduction/lucy-flux"],
    "discretisation": {"density": ["given", "summation"],
                       "layout": ["lattice", {"id": "jittered", "amplitude": 0.1, "seeds": [3, 1]}]},
    "resolution": [25, 50, 100], "smoothing_exponent": [0, 0.5]})");
  BOOST_TEST(e.runs.size() == 2u * 2u * 2u * 3u * 3u * 2u);
  BOOST_TEST(e.skipped.empty());
  BOOST_TEST(e.runs[0].resolution == 25);
  BOOST_TEST(e.runs[1].resolution == 50);
  BOOST_TEST(e.runs[3].smoothing_exponent == 0.5);
  BOOST_TEST(e.runs[6].discretisation.layout.seed == 3u);
  BOOST_TEST(e.runs[12].discretisation.layout.seed == 1u);
  BOOST_TEST(e.runs[18].discretisation.density == "summation");
  BOOST_TEST(e.runs[36].formulation.id == "conduction/lucy-flux");
  BOOST_TEST(e.runs[72].scene_case->info.id == "conduction/slab-insulated");
  std::set<std::string> different;
  for (RunSpec const& run : e.runs) {
    different.insert(run.scene_case->info.id + run.label + run.discretisation.density +
                     to_json(run.discretisation.layout).dump() + std::to_string(run.smoothing_exponent) +
                     "/" + std::to_string(run.resolution));
  }
  BOOST_TEST(different.size() == e.runs.size());
}

BOOST_AUTO_TEST_CASE(the_smoothing_ratio_grows_with_the_resolution_as_the_exponent_says) {
  Expansion const e = expansion(R"({
    "cases": "conduction/slab-dirichlet", "formulations": "conduction/brookshaw",
    "discretisation": {"smoothing_ratio": 1.2}, "resolution": [25, 40, 100],
    "smoothing_exponent": [0, 0.5, -0.25]})");
  BOOST_TEST(e.runs.size() == 9u);
  for (RunSpec const& run : e.runs) {
    BOOST_TEST(run.smoothing_ratio == 1.2 * std::pow(run.resolution / 25.0, run.smoothing_exponent),
               tolerance(1e-15));
    BOOST_TEST(run.discretisation.smoothing_ratio == 1.2);
  }
  BOOST_TEST(e.runs[5].smoothing_ratio == 2.4, tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense_is_skipped_once_with_a_reason) {
  Expansion const e = expansion(R"({
    "cases": ["conduction/slab-dirichlet", "operator/sine"],
    "formulations": ["momentum/p-rho2", "work/internal-energy", "conduction/brookshaw",
                     {"id": "momentum/p-rho2", "work": "work/total-energy"}],
    "discretisation": {"density": ["given", "summation"]}, "resolution": [10, 20]})");
  // Conduction runs one form, the operator case three without partners; two densities, two resolutions each.
  BOOST_TEST(e.runs.size() == 4u + 3u * 4u);
  std::vector<std::pair<std::string, std::string>> skipped;
  for (Skipped const& s : e.skipped) {
    BOOST_TEST(!s.reason.empty());
    skipped.emplace_back(s.case_id, s.formulation);
  }
  std::vector<std::pair<std::string, std::string>> const expected{
      {"conduction/slab-dirichlet", "momentum/p-rho2"},
      {"conduction/slab-dirichlet", "work/internal-energy"},
      {"conduction/slab-dirichlet", "momentum/p-rho2 + work/total-energy"},
      {"operator/sine", "momentum/p-rho2 + work/total-energy"}};
  BOOST_TEST((skipped == expected));
  BOOST_TEST(e.skipped[0].reason.find("momentum") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(choices_at_walls_are_not_repeated_where_the_walls_are_off) {
  Expansion const e = expansion(R"({
    "cases": "conduction/slab-dirichlet",
    "formulations": ["conduction/brookshaw", {"id": "conduction/brookshaw", "walls": "off"}],
    "discretisation": {"face_weight": ["balanced", "exact", "campbell"]},
    "closure": ["interpolated", "one-sided"], "resolution": [10, 20]})");
  std::size_t on = 0;
  std::size_t off = 0;
  for (RunSpec const& run : e.runs) ++(run.formulation.walls ? on : off);
  BOOST_TEST(on == 3u * 2u * 2u);
  BOOST_TEST(off == 2u);
  BOOST_TEST(e.skipped.size() == 3u);  // two face weights and one closure that change nothing
  for (Skipped const& s : e.skipped) BOOST_TEST(s.formulation == "conduction/brookshaw (walls off)");
}

BOOST_AUTO_TEST_CASE(integrators_are_not_repeated_where_no_time_passes) {
  Expansion const e = expansion(R"({
    "cases": ["operator/sine", "conduction/slab-dirichlet"], "formulations": "conduction/brookshaw",
    "integrator": ["bdf", "runge-kutta"], "resolution": 10})");
  BOOST_TEST(e.runs.size() == 3u);
  BOOST_TEST(e.skipped.size() == 1u);
}

BOOST_AUTO_TEST_CASE(labels_tell_formulations_apart) {
  Expansion const e = expansion(R"({
    "cases": "operator/sine",
    "formulations": ["conduction/brookshaw", {"id": "conduction/brookshaw", "walls": "off"},
                     "momentum/p-rho2"], "resolution": 10})");
  BOOST_TEST(e.runs[0].label == "conduction/brookshaw");
  BOOST_TEST(e.runs[1].label == "conduction/brookshaw (walls off)");
  BOOST_TEST(e.runs[2].label == "momentum/p-rho2");
}

BOOST_AUTO_TEST_SUITE_END()
