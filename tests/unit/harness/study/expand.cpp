// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/expand.hpp"

#include <algorithm>
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

// ---- Moving gas

std::vector<std::string> reasons(Expansion const& e) {
  std::vector<std::string> all;
  for (Skipped const& s : e.skipped) all.push_back(s.reason);
  return all;
}

bool is_skipped_for(Expansion const& e, std::string const& words) {
  for (std::string const& reason : reasons(e)) {
    if (reason.find(words) != std::string::npos) return true;
  }
  return false;
}

BOOST_AUTO_TEST_CASE(a_moving_gas_takes_its_momentum_form_s_partner_unless_it_is_named) {
  Expansion const e = expansion(R"({
    "cases": "hydro/uniform",
    "formulations": ["momentum/p-rho2", "momentum/sqrt-p", "momentum/direct-gradient",
                     {"id": "momentum/p-rho2", "work": "work/total-energy"},
                     {"id": "momentum/p-rho2", "walls": "off"}], "resolution": 10})");
  BOOST_TEST_REQUIRE(e.runs.size() == 5u);
  BOOST_TEST(e.skipped.empty());
  BOOST_TEST(e.runs[0].formulation.work == "work/internal-energy");
  BOOST_TEST(e.runs[1].formulation.work == "work/sqrt-p");
  BOOST_TEST(e.runs[2].formulation.work == "work/internal-energy");
  BOOST_TEST(e.runs[3].formulation.work == "work/total-energy");
  BOOST_TEST(e.runs[0].label == "momentum/p-rho2 + work/internal-energy");
  BOOST_TEST(e.runs[3].label == "momentum/p-rho2 + work/total-energy");
  BOOST_TEST(e.runs[4].label == "momentum/p-rho2 + work/internal-energy (walls off)");
}

BOOST_AUTO_TEST_CASE(a_gas_needs_a_momentum_form_and_conducts_where_it_conducts) {
  Expansion const e = expansion(R"({
    "cases": ["hydro/uniform", "coupled/hot-wall"],
    "formulations": ["conduction/brookshaw", "work/internal-energy", "momentum/p-rho2",
                     {"id": "momentum/p-rho2", "conduction": "conduction/brookshaw"}], "resolution": 10})");
  BOOST_TEST_REQUIRE(e.runs.size() == 2u);
  BOOST_TEST(e.runs[0].scene_case->info.id == "hydro/uniform");
  BOOST_TEST(e.runs[0].formulation.conduction == "");
  BOOST_TEST(e.runs[1].scene_case->info.id == "coupled/hot-wall");
  BOOST_TEST(e.runs[1].label == "momentum/p-rho2 + work/internal-energy + conduction/brookshaw");
  std::vector<std::string> const expected{"a moving gas needs a momentum form, with this one as its partner",
                                          "a moving gas needs a momentum form, with this one as its partner",
                                          "a gas that conducts no heat takes no conduction form",
                                          "a moving gas needs a momentum form, with this one as its partner",
                                          "a moving gas needs a momentum form, with this one as its partner",
                                          "a gas that conducts heat needs a conduction form"};
  BOOST_TEST(reasons(e) == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(by_default_what_jumps_is_leapfrogged_with_viscosity_and_what_is_smooth_is_not) {
  Expansion const e = expansion(R"({
    "cases": ["hydro/piston-velocity", "hydro/manufactured", "hydro/noh", "hydro/acoustic"],
    "formulations": "momentum/p-rho2", "resolution": 10})");
  BOOST_TEST_REQUIRE(e.runs.size() == 4u);
  for (RunSpec const& run : e.runs) {
    bool const jumps = run.scene_case->info.discontinuous;
    BOOST_TEST(jumps == (run.scene_case->info.id == "hydro/piston-velocity" ||
                         run.scene_case->info.id == "hydro/noh"));
    BOOST_TEST(run.discretisation.integrator == (jumps ? "leapfrog" : "runge-kutta"));
    BOOST_TEST((run.discretisation.viscosity == (jumps ? ViscosityChoice{1.0, 2.0} : ViscosityChoice{})));
    BOOST_TEST(run.discretisation.density == "continuity");
    BOOST_TEST(run.discretisation.smoothing == "uniform");
    BOOST_TEST(run.discretisation.wall_motion == "velocity");
  }
}

BOOST_AUTO_TEST_CASE(viscosities_that_come_to_the_same_are_run_once) {
  std::string const rest = R"("formulations": "momentum/p-rho2", "resolution": 10,
    "viscosity": ["auto", "off", {"alpha": 1, "beta": 2}, {"alpha": 2, "beta": 2}]})";
  for (char const* scene_case : {"hydro/piston-velocity", "hydro/uniform"}) {
    Expansion const e = expansion(R"({"cases": ")" + std::string(scene_case) + R"(", )" + rest);
    BOOST_TEST(e.runs.size() == 3u);
    BOOST_TEST(e.skipped.empty());
  }
}

BOOST_AUTO_TEST_CASE(particles_at_rest_are_not_repeated_for_what_only_moves) {
  Expansion const e = expansion(R"({
    "cases": ["conduction/slab-dirichlet", "operator/sine"], "formulations": "conduction/brookshaw",
    "viscosity": ["auto", "off", {"alpha": 2, "beta": 2}], "smoothing": ["adaptive", "uniform"],
    "wall_motion": ["mass", "velocity"], "resolution": 10})");
  BOOST_TEST_REQUIRE(e.runs.size() == 2u);
  BOOST_TEST(e.skipped.empty());
  for (RunSpec const& run : e.runs) {
    BOOST_TEST((run.discretisation.viscosity == ViscosityChoice{}));
    BOOST_TEST(run.discretisation.smoothing == "uniform");
    BOOST_TEST(run.discretisation.wall_motion == "velocity");
  }
}

BOOST_AUTO_TEST_CASE(densities_and_integrators_go_to_the_particles_that_they_are_for) {
  Expansion const e = expansion(R"({
    "cases": ["conduction/slab-dirichlet", "hydro/uniform"],
    "formulations": ["conduction/brookshaw", "momentum/p-rho2"],
    "discretisation": {"density": ["given", "summation", "normalised", "continuity"]},
    "integrator": ["bdf", "runge-kutta", "leapfrog"], "resolution": 10})");
  std::size_t at_rest = 0, in_motion = 0;
  for (RunSpec const& run : e.runs) {
    bool const moving = run.scene_case->info.id == "hydro/uniform";
    ++(moving ? in_motion : at_rest);
    BOOST_TEST(run.discretisation.density != (moving ? "given" : "continuity"));
    BOOST_TEST(run.discretisation.integrator != (moving ? "bdf" : "leapfrog"));
  }
  BOOST_TEST(at_rest == 3u * 2u);
  BOOST_TEST(in_motion == 3u * 2u);
  BOOST_TEST(is_skipped_for(e, "given density is for particles at rest"));
  BOOST_TEST(is_skipped_for(e, "continuity density needs particles that move"));
  BOOST_TEST(is_skipped_for(e, "bdf is for particles at rest"));
  BOOST_TEST(is_skipped_for(e, "leapfrog is for particles that move"));
}

BOOST_AUTO_TEST_CASE(a_study_of_both_kinds_runs_each_with_its_own_defaults) {
  Expansion const e = expansion(R"({
    "cases": ["conduction/slab-dirichlet", "hydro/piston-velocity"],
    "formulations": ["conduction/brookshaw", "momentum/p-rho2"], "resolution": 10})");
  BOOST_TEST_REQUIRE(e.runs.size() == 2u);
  BOOST_TEST(e.runs[0].discretisation.density == "given");
  BOOST_TEST(e.runs[0].discretisation.integrator == "bdf");
  BOOST_TEST(e.runs[1].discretisation.density == "continuity");
  BOOST_TEST(e.runs[1].discretisation.integrator == "leapfrog");
}

BOOST_AUTO_TEST_CASE(wall_motions_are_compared_only_where_a_wall_goes_with_the_gas) {
  Expansion const e = expansion(R"({
    "cases": ["hydro/piston-pressure", "hydro/piston-velocity",
              {"id": "hydro/manufactured", "parameters": {"drive": "pressure"}},
              {"id": "hydro/manufactured", "parameters": {"drive": "both"}},
              {"id": "hydro/manufactured", "parameters": {"drive": "pressure", "dimension": 2}}],
    "formulations": ["momentum/p-rho2", {"id": "momentum/p-rho2", "walls": "off"}],
    "wall_motion": ["velocity", "mass"], "resolution": 10})");
  std::size_t by_mass = 0;
  for (RunSpec const& run : e.runs) {
    if (run.discretisation.wall_motion == "velocity") continue;
    ++by_mass;
    BOOST_TEST(run.formulation.walls);
    BOOST_TEST((run.scene_case->info.id == "hydro/piston-pressure" ||
                std::get<std::string>(run.parameters.all().at("drive")) == "pressure"));
  }
  BOOST_TEST(by_mass == 2u);
  BOOST_TEST(e.runs.size() == 5u * 2u + by_mass);
  BOOST_TEST(is_skipped_for(e, "wall motion mass is for one dimension"));
  BOOST_TEST(is_skipped_for(e, "wall motion mass changes nothing where no wall goes with the gas"));
}

BOOST_AUTO_TEST_CASE(grad_h_terms_run_where_h_follows_a_density_that_is_summed_and_say_why_not_elsewhere) {
  Expansion const e = expansion(R"({
    "cases": ["hydro/riemann", "operator/sine"],
    "formulations": ["momentum/p-rho2-grad-h", {"id": "momentum/p-rho2", "work": "work/p-rho2-grad-h"}],
    "discretisation": {"density": ["continuity", "summation", "normalised", "voronoi"], "smoothing": ["uniform", "adaptive"],
                       "pair_weight": ["kernel", "voronoi"]},
    "resolution": 20})");
  BOOST_TEST(e.runs.size() == 4u);  // two formulations, two densities
  for (RunSpec const& run : e.runs) {
    BOOST_TEST(run.discretisation.smoothing == "adaptive");
    BOOST_TEST((run.discretisation.density == "summation" || run.discretisation.density == "normalised"));
    BOOST_TEST(run.discretisation.pair_weight == "kernel");
    BOOST_TEST(run.formulation.work == "work/p-rho2-grad-h");
  }
  auto const is_said = [&](std::string const& case_id, std::string const& form, std::string const& why) {
    return std::any_of(e.skipped.begin(), e.skipped.end(), [&](Skipped const& s) {
      return s.case_id == case_id && s.formulation.find(form) != std::string::npos && s.reason.find(why) != std::string::npos;
    });
  };
  for (char const* form : {"momentum/p-rho2-grad-h", "momentum/p-rho2 + work/p-rho2-grad-h"}) {
    BOOST_TEST(is_said("hydro/riemann", form, "with one h for all it is the form without grad-h terms"));
    BOOST_TEST(is_said("hydro/riemann", form, "instead of continuity take summation or normalised"));
    BOOST_TEST(is_said("hydro/riemann", form, "instead of voronoi take summation or normalised"));
    BOOST_TEST(is_said("hydro/riemann", form, "pair weight voronoi"));
  }
  BOOST_TEST(is_said("operator/sine", "momentum/p-rho2-grad-h", "particles at rest have one h for all"));
}

BOOST_AUTO_TEST_CASE(a_layout_that_a_dimension_does_not_have_is_skipped_with_its_reason) {
  Expansion const e = expansion(R"({
    "cases": [{"id": "conduction/slab-dirichlet", "parameters": {"dimension": 1}},
              {"id": "conduction/slab-dirichlet", "parameters": {"dimension": 2}},
              {"id": "conduction/slab-dirichlet", "parameters": {"dimension": 3}}],
    "formulations": "conduction/brookshaw", "resolution": [10],
    "discretisation": {"layout": ["equal-mass", "hexagonal", "close-packed", {"id": "glass", "seed": 1}]}})");
  BOOST_TEST(e.runs.size() == 1u + 2u + 2u);
  BOOST_TEST(is_skipped_for(e, "layout equal-mass is for one dimension"));
  BOOST_TEST(is_skipped_for(e, "layout hexagonal is for two dimensions"));
  BOOST_TEST(is_skipped_for(e, "layout close-packed is for three dimensions"));
  BOOST_TEST(is_skipped_for(e, "layout glass is for two and three dimensions"));
}

BOOST_AUTO_TEST_CASE(a_case_that_is_a_reference_only_is_skipped_with_its_reason) {
  Expansion const e = expansion(R"({
    "cases": ["hydro/noh", {"id": "hydro/riemann", "parameters": {"left": [1, 0, 1], "right": [0, 0, 0]}}],
    "formulations": "momentum/p-rho2", "resolution": [10, 20]})");
  BOOST_TEST(e.runs.size() == 2u);
  BOOST_TEST(is_skipped_for(e, "particles fill no vacuum"));
  BOOST_TEST(e.skipped.at(0).case_id == "hydro/riemann");
  BOOST_TEST(e.skipped[0].formulation == "momentum/p-rho2 + work/internal-energy");
}

BOOST_AUTO_TEST_SUITE_END()
