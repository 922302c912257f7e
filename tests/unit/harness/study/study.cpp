// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/study.hpp"

#include <boost/test/unit_test.hpp>

#include "tests/support/documents.hpp"

BOOST_AUTO_TEST_SUITE(harness_study_study)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::per_element;
using Words = std::vector<std::string>;
using Numbers = std::vector<double>;

Json smallest() {
  return Json::parse(R"({"schema": "sphverify-study/1", "name": "small",
                         "cases": "conduction/slab-dirichlet", "formulations": "conduction/brookshaw",
                         "resolution": 25})");
}

Study read(Json const& document) { return read_study(Node(document, "study.json")); }

std::string refusal(Json const& document) {
  return complaint([&] { read(document); });
}

/// What is said of the smallest study with one key set to a value.
std::string refusal(std::string const& key, std::string const& value) {
  Json document = smallest();
  document[key] = Json::parse(value);
  return refusal(document);
}

void check_says(std::string const& said, Words const& parts) {
  BOOST_TEST(!said.empty());
  for (std::string const& part : parts)
    BOOST_TEST(said.find(part) != std::string::npos, "'" << said << "' lacks '" << part << "'");
  BOOST_TEST(said.find('\n') == std::string::npos, said);
}

BOOST_AUTO_TEST_CASE(defaults_are_filled_in) {
  Study const study = read(smallest());
  BOOST_TEST(study.name == "small");
  BOOST_TEST(study.cases.size() == 1u);
  BOOST_TEST(study.cases[0].scene_case->info.id == "conduction/slab-dirichlet");
  BOOST_TEST(study.cases[0].parameters.number("final_time") == 0.05);
  BOOST_TEST(study.formulations.size() == 1u);
  BOOST_TEST(study.formulations[0].walls);
  BOOST_TEST(study.kernels == Words{"cubic-spline"}, per_element());
  BOOST_TEST(study.densities == Words{"given"}, per_element());
  BOOST_TEST(study.face_weights == Words{"exact"}, per_element());
  BOOST_TEST(study.closures == Words{"interpolated"}, per_element());
  BOOST_TEST(study.integrators == Words{"bdf"}, per_element());
  BOOST_TEST(study.smoothing_ratios == Numbers{1.2}, per_element());
  BOOST_TEST(study.smoothing_exponents == Numbers{0.0}, per_element());
  BOOST_TEST(study.layouts.size() == 1u);
  BOOST_TEST(study.layouts[0].id == "lattice");
  BOOST_TEST(study.resolutions == std::vector<int>{25}, per_element());
  BOOST_TEST((study.measure == MeasureSet{Measure::error, Measure::conservation, Measure::cost}));
  BOOST_TEST(study.threads == 1);
  BOOST_TEST(study.repeat.most == 1);
  BOOST_TEST(study.time_budget > 0.0);
}

BOOST_AUTO_TEST_CASE(one_value_or_many_are_both_fine) {
  Json document = smallest();
  document["cases"] = Json::parse(R"(["operator/sine", {"id": "conduction/slab-dirichlet", "parameters":
                      {"final_time": 0.04, "modes": [[2, 0.5]]}}])");
  document["formulations"] =
      Json::parse(R"(["conduction/brookshaw", {"id": "conduction/lucy-flux", "walls": "off"},
                      {"id": "momentum/p-rho2", "work": "work/total-energy",
                       "conduction": "conduction/brookshaw"}])");
  document["discretisation"] = Json::parse(
      R"({"density": ["given", "summation"], "smoothing_ratio": [1.0, 1.2],
          "layout": ["lattice", {"id": "jittered", "amplitude": 0.1, "seed": 7},
                     {"id": "jittered", "amplitude": 0.2, "seeds": [1, 2, 3]}],
          "face_weight": "balanced"})");
  document["resolution"] = {25, 50, 100};
  document["smoothing_exponent"] = {0, 0.5};
  document["closure"] = "one-sided";
  document["integrator"] = {"bdf", "runge-kutta"};
  document["measure"] = "stability";
  document["threads"] = 2;
  document["repeat"] = 3;
  document["time_budget"] = 12.5;
  Study const study = read(document);
  BOOST_TEST(study.cases.size() == 2u);
  BOOST_TEST(study.cases[1].parameters.number("final_time") == 0.04);
  BOOST_TEST(study.cases[1].parameters.number("left") == 1.0);
  BOOST_TEST(study.cases[1].parameters.table("modes").size() == 1u);
  BOOST_TEST(!study.formulations[1].walls);
  BOOST_TEST(study.formulations[2].work == "work/total-energy");
  BOOST_TEST(study.formulations[2].conduction == "conduction/brookshaw");
  BOOST_TEST(study.densities.size() == 2u);
  BOOST_TEST(study.layouts.size() == 5u);
  BOOST_TEST(study.layouts[1].seed == 7u);
  BOOST_TEST(study.layouts[4].seed == 3u);
  BOOST_TEST(study.layouts[4].amplitude == 0.2);
  BOOST_TEST(study.face_weights == Words{"balanced"}, per_element());
  BOOST_TEST(study.closures == Words{"one-sided"}, per_element());
  BOOST_TEST(study.integrators.size() == 2u);
  BOOST_TEST(study.resolutions.size() == 3u);
  BOOST_TEST(study.smoothing_exponents == (Numbers{0.0, 0.5}), per_element());
  BOOST_TEST((study.measure == MeasureSet{Measure::stability}));
  BOOST_TEST(study.threads == 2);
  BOOST_TEST(study.repeat.most == 3);
  BOOST_TEST(study.repeat.least == 3);
  BOOST_TEST(study.repeat.spread == 0.0, "exactly so often");
  BOOST_TEST(study.time_budget == 12.5);
  BOOST_TEST(to_json(study)["time_budget"] == 12.5);
}

BOOST_AUTO_TEST_CASE(repeats_go_on_until_there_are_enough) {
  auto const rule = [](std::string const& text) {
    Json document = smallest();
    document["repeat"] = Json::parse(text);
    Study const study = read(document);
    BOOST_TEST(to_json(read(to_json(study))).dump() == to_json(study).dump());
    return study.repeat;
  };
  RepeatRule const usual = rule("{}");
  BOOST_TEST(usual.most == 25);
  BOOST_TEST(usual.least == 6);
  BOOST_TEST(usual.spread == 0.02);
  BOOST_TEST(usual.seconds == 2.0);
  RepeatRule const own = rule(R"({"most": 40, "least": 10, "spread": 0.05, "seconds": 0.5})");
  BOOST_TEST(own.most == 40);
  BOOST_TEST(own.least == 10);
  BOOST_TEST(own.spread == 0.05);
  BOOST_TEST(own.seconds == 0.5);
  BOOST_TEST(rule(R"({"most": 3})").least == 3, "what is not named gives way");
  BOOST_TEST(rule(R"({"least": 50})").most == 50);
}

BOOST_AUTO_TEST_CASE(repeats_that_make_no_sense_are_refused) {
  check_says(refusal("repeat", "[3]"), {"study.json: repeat", "a whole number from 1 to 1000, or an object"});
  check_says(refusal("repeat", R"("often")"), {"repeat: found 'often'", "or an object"});
  check_says(refusal("repeat", "1001"), {"repeat: found 1001"});
  check_says(refusal("repeat", R"({"most": 0})"), {"repeat.most: found 0"});
  check_says(refusal("repeat", R"({"most": 5, "least": 6})"), {"repeat.least: found 6", "at most 5"});
  check_says(refusal("repeat", R"({"least": 1.5})"), {"repeat.least: found 1.5"});
  check_says(refusal("repeat", R"({"spread": 0})"), {"repeat.spread: found 0"});
  check_says(refusal("repeat", R"({"spread": 2})"), {"repeat.spread: found 2", "at most 1"});
  check_says(refusal("repeat", R"({"seconds": -1})"), {"repeat.seconds: found -1"});
  check_says(refusal("repeat", R"({"second": 1})"), {"repeat.second: found an unknown key", "did you mean"});
}

BOOST_AUTO_TEST_CASE(a_study_written_down_reads_back_as_itself) {
  Json document = smallest();
  document["cases"] = Json::parse(
      R"(["operator/polynomial", {"id": "conduction/slab-dirichlet", "parameters": {"modes": [[2, 0.3]]}}])");
  document["formulations"] = Json::parse(R"([{"id": "momentum/p-rho2", "work": "work/total-energy"},
                      {"id": "conduction/lucy-flux", "walls": "off"}])");
  document["discretisation"] = Json::parse(
      R"({"density": ["summation", "given"], "layout": {"id": "jittered", "amplitude": 0.1, "seeds": [4, 2]},
          "smoothing_ratio": 1.3333333333333333})");
  document["measure"] = {"spectrum", "error"};
  document["resolution"] = {7, 11};
  Study const study = read(document);
  Json const written = to_json(study);
  Json const again = to_json(read(written));
  BOOST_TEST(written.dump() == again.dump());
  BOOST_TEST(written.at("discretisation").at("smoothing_ratio")[0].get<double>() == 1.3333333333333333);
  BOOST_TEST((read(written).formulations == study.formulations));
  BOOST_TEST((read(written).layouts == study.layouts));
  BOOST_TEST((read(written).cases[1].parameters == study.cases[1].parameters));
  BOOST_TEST((read(written).measure == study.measure));
}

BOOST_AUTO_TEST_CASE(the_standard_study_is_a_study) {
  std::string const path = SPHVERIFY_SOURCE_DIR "/cases/studies/conduction-walls-1d.json";
  Study const study = read_study(Node(read_json_file(path), path));
  BOOST_TEST(study.formulations.size() == 6u);
  BOOST_TEST(study.cases.size() == 3u);
  BOOST_TEST(study.resolutions.size() >= 4u);
  BOOST_TEST(study.smoothing_exponents.size() == 2u);
  BOOST_TEST(study.densities.size() == 2u);
  std::size_t replicates = 0;
  for (LayoutChoice const& layout : study.layouts) replicates += layout.id == "jittered" ? 1 : 0;
  BOOST_TEST(replicates >= 5u);
}

BOOST_AUTO_TEST_CASE(an_unknown_key_is_named_with_the_nearest_one) {
  check_says(refusal("resolutions", "25"),
             {"study.json: resolutions: found an unknown key", "did you mean 'resolution'?"});
  check_says(refusal("discretisation", R"({"smoothing_ration": 1})"),
             {"discretisation.smoothing_ration", "did you mean 'smoothing_ratio'?"});
  check_says(refusal("cases", R"([{"id": "operator/sine", "parameters": {"phse": 1}}])"),
             {"study.json: cases[0].parameters.phse", "did you mean 'phase'?"});
  check_says(refusal("formulations", R"({"id": "conduction/brookshaw", "wall": "off"})"),
             {"formulations.wall", "did you mean 'walls'?"});
  check_says(refusal("discretisation", R"({"layout": {"id": "jittered", "amplitud": 0.1, "seed": 1}})"),
             {"discretisation.layout.amplitud", "did you mean 'amplitude'?"});
  check_says(refusal("discretisation", R"({"layout": {"id": "lattice", "seed": 1}})"),
             {"discretisation.layout.seed", "unknown key"});
}

BOOST_AUTO_TEST_CASE(an_unknown_identifier_is_named_with_the_nearest_one) {
  check_says(refusal("formulations", R"(["conduction/brokshaw"])"),
             {"study.json: formulations[0]: found 'conduction/brokshaw', expected one of",
              "did you mean 'conduction/brookshaw'?"});
  check_says(refusal("formulations", R"("brookshaw")"), {"did you mean 'conduction/brookshaw'?"});
  check_says(
      refusal("cases", R"("conduction/slab-dirichlett")"),
      {"study.json: cases: found 'conduction/slab-dirichlett'", "did you mean 'conduction/slab-dirichlet'?"});
  check_says(refusal("discretisation", R"({"kernel": "cubic"})"),
             {"discretisation.kernel: found 'cubic'", "cubic-spline"});
  check_says(refusal("discretisation", R"({"density": "sumation"})"), {"did you mean 'summation'?"});
  check_says(refusal("discretisation", R"({"face_weight": ["exact", "ballanced"]})"),
             {"discretisation.face_weight[1]", "did you mean 'balanced'?"});
  check_says(refusal("closure", R"("onesided")"), {"closure", "did you mean 'one-sided'?"});
  check_says(refusal("integrator", R"("rk")"), {"integrator: found 'rk'", "bdf, implicit-runge-kutta"});
  check_says(refusal("measure", R"(["error", "costs"])"), {"measure[1]", "did you mean 'cost'?"});
  check_says(refusal("discretisation", R"({"layout": "latice"})"), {"did you mean 'lattice'?"});
  check_says(refusal("formulations", R"({"id": "momentum/p-rho2", "work": "conduction/brookshaw"})"),
             {"formulations.work", "work/total-energy"});
}

BOOST_AUTO_TEST_CASE(a_value_of_the_wrong_type_is_shown_with_what_was_expected) {
  check_says(refusal("name", "3"), {"study.json: name: found 3, expected a string"});
  check_says(refusal("threads", R"("many")"), {"threads: found 'many', expected a whole number"});
  check_says(refusal("threads", "1.5"), {"threads: found 1.5, expected a whole number"});
  check_says(refusal("repeat", "0"), {"repeat: found 0"});
  check_says(refusal("time_budget", "-1"), {"time_budget: found -1, expected a positive number"});
  check_says(refusal("time_budget", "null"), {"time_budget: found null, expected a positive number"});
  check_says(refusal("discretisation", R"({"smoothing_ratio": [1.2, 0]})"),
             {"discretisation.smoothing_ratio[1]: found 0, expected a number from 0.001 to 1e+06"});
  check_says(refusal("discretisation", R"({"smoothing_ratio": true})"), {"found true"});
  check_says(refusal("discretisation", "[]"), {"discretisation", "expected an object"});
  check_says(refusal("smoothing_exponent", "7"), {"smoothing_exponent: found 7"});
  check_says(refusal("cases", "[]"), {"cases: found an empty list"});
  check_says(refusal("cases", "[4]"), {"cases[0]"});
  check_says(refusal("measure", "{}"), {"measure: found an object"});
  check_says(refusal("formulations", R"({"id": "conduction/brookshaw", "walls": true})"),
             {"formulations.walls: found true", "on, off"});
}

BOOST_AUTO_TEST_CASE(resolutions_are_positive_whole_numbers_in_ascending_order) {
  check_says(refusal("resolution", "-25"), {"study.json: resolution: found -25, expected a whole number"});
  check_says(refusal("resolution", "0"), {"resolution: found 0"});
  check_says(refusal("resolution", "[25, 12.5]"), {"resolution[1]: found 12.5"});
  check_says(refusal("resolution", "[50, 25]"), {"resolution[1]: found 25", "ascending"});
  check_says(refusal("resolution", "[25, 25]"), {"resolution[1]: found 25"});
  check_says(refusal("resolution", R"(["25"])"), {"resolution[0]: found '25'"});
  check_says(refusal("resolution", "[]"), {"resolution: found an empty list"});
  check_says(refusal("resolution", "1e300"), {"resolution: found 1e+300"});
}

BOOST_AUTO_TEST_CASE(a_missing_key_is_named) {
  for (char const* key : {"schema", "name", "cases", "formulations", "resolution"}) {
    Json document = smallest();
    document.erase(key);
    check_says(refusal(document), {"study.json: " + std::string(key) + ": found nothing"});
  }
  check_says(refusal("cases", R"({"parameters": {}})"), {"cases.id: found nothing"});
}

BOOST_AUTO_TEST_CASE(another_document_is_refused) {
  check_says(refusal("schema", R"("sphverify-results/1")"),
             {"schema: found 'sphverify-results/1', expected sphverify-study/1"});
  check_says(refusal("schema", "1"), {"schema: found 1"});
  check_says(refusal(Json::array()), {"study.json: found an empty list"});
}

BOOST_AUTO_TEST_CASE(clumped_and_touching_layouts_have_a_distance_of_their_own_name_and_a_default) {
  Json document = smallest();
  document["discretisation"]["layout"] = Json::parse(
      R"(["clumped", "touching", {"id": "clumped", "separation": 0.5}, {"id": "touching", "gap": 0.001}])");
  Study const study = read(document);
  std::vector<LayoutChoice> const expected{
      {"clumped", 0.1}, {"touching", 1e-12}, {"clumped", 0.5}, {"touching", 1e-3}};
  BOOST_TEST((study.layouts == expected));
  BOOST_TEST((read(to_json(study)).layouts == expected));
  auto const layout = [](std::string const& value) {
    return refusal("discretisation", R"({"layout": )" + value + "}");
  };
  check_says(layout(R"({"id": "clumped", "separation": 1.5})"), {"layout.separation: found 1.5"});
  check_says(layout(R"({"id": "touching", "gap": 0})"), {"layout.gap: found 0"});
  check_says(layout(R"({"id": "touching", "separation": 0.1})"), {"layout.separation", "unknown key"});
}

BOOST_AUTO_TEST_CASE(a_jittered_layout_needs_an_amplitude_below_half_and_seeds) {
  auto const layout = [](std::string const& value) {
    return refusal("discretisation", R"({"layout": )" + value + "}");
  };
  check_says(layout(R"("jittered")"), {"discretisation.layout: found 'jittered'", "amplitude", "seed"});
  check_says(layout(R"({"id": "jittered", "amplitude": 0.1})"),
             {"discretisation.layout.seed: found nothing"});
  check_says(layout(R"({"id": "jittered", "seed": 1})"), {"discretisation.layout.amplitude: found nothing"});
  check_says(layout(R"({"id": "jittered", "amplitude": 0.5, "seed": 1})"),
             {"discretisation.layout.amplitude: found 0.5"});
  check_says(layout(R"({"id": "jittered", "amplitude": -0.1, "seed": 1})"), {"amplitude: found -0.1"});
  check_says(layout(R"({"id": "jittered", "amplitude": 0.1, "seed": -1})"), {"layout.seed: found -1"});
  check_says(layout(R"({"id": "jittered", "amplitude": 0.1, "seed": 1, "seeds": [2]})"), {"seed"});
  check_says(layout(R"({"id": "jittered", "amplitude": 0.1, "seeds": []})"), {"seeds: found an empty list"});
  // Twice the same particles would be taken for replicates.
  check_says(layout(R"({"id": "jittered", "amplitude": 0, "seeds": [1, 2]})"),
             {"layout.seeds: found", "one seed"});
}

BOOST_AUTO_TEST_CASE(a_value_given_twice_is_refused) {
  check_says(refusal("formulations", R"(["conduction/brookshaw", "conduction/brookshaw"])"),
             {"formulations[1]", "only once"});
  check_says(
      refusal("formulations", R"(["conduction/brookshaw", {"id": "conduction/brookshaw", "walls": "on"}])"),
      {"formulations[1]", "only once"});
  BOOST_TEST(refusal("formulations",
                     R"(["conduction/brookshaw", {"id": "conduction/brookshaw", "walls": "off"}])") == "");
  check_says(refusal("discretisation", R"({"density": ["given", "given"]})"), {"density[1]", "only once"});
  check_says(refusal("discretisation", R"({"smoothing_ratio": [1.2, 1.20]})"),
             {"smoothing_ratio[1]", "only once"});
  check_says(refusal("smoothing_exponent", "[0, 0.0]"), {"smoothing_exponent[1]", "only once"});
  check_says(
      refusal("discretisation", R"({"layout": {"id": "jittered", "amplitude": 0.1, "seeds": [1, 1]}})"),
      {"seeds[1]", "only once"});
}

// A layout or a case twice would make every run a replicate of itself, and the interval too narrow.
BOOST_AUTO_TEST_CASE(a_layout_given_twice_is_refused) {
  check_says(refusal("discretisation", R"({"layout": ["lattice", "lattice"]})"), {"layout[1]"});
  check_says(refusal("discretisation", R"({"layout": [{"id": "jittered", "amplitude": 0.1, "seed": 1},
                                                      {"id": "jittered", "amplitude": 0.1, "seeds": [2, 1]}
                                                     ]})"),
             {"layout[1]"});
}

BOOST_AUTO_TEST_CASE(a_case_given_twice_is_refused) {
  check_says(refusal("cases", R"(["conduction/slab-dirichlet", {"id": "conduction/slab-dirichlet"}])"),
             {"cases[1]"});
  BOOST_TEST(refusal("cases", R"(["conduction/slab-dirichlet",
                                  {"id": "conduction/slab-dirichlet", "parameters": {"left": 2}}])") == "");
}

BOOST_AUTO_TEST_CASE(a_choice_stands_in_one_place_only) {
  Json document = smallest();
  document["closure"] = "one-sided";
  document["discretisation"] = {{"closure", "interpolated"}};
  check_says(refusal(document), {"study.json: closure"});
}

BOOST_AUTO_TEST_CASE(only_a_momentum_form_has_partners) {
  check_says(refusal("formulations", R"({"id": "conduction/brookshaw", "work": "work/total-energy"})"),
             {"formulations.work", "momentum form"});
}

BOOST_AUTO_TEST_CASE(bad_parameters_are_refused_in_the_case_s_own_words) {
  auto const slab = [](std::string const& parameters) {
    return refusal("cases", R"([{"id": "conduction/slab-dirichlet", "parameters": )" + parameters + "}]");
  };
  check_says(slab(R"({"conductivity": -1})"),
             {"study.json: cases[0].parameters.conductivity: found -1, expected positive"});
  check_says(slab(R"({"conductivity": "high"})"),
             {"study.json: cases[0].parameters.conductivity: found 'high', expected a number"});
  check_says(slab(R"({"final_time": 0})"), {"cases[0].parameters.final_time: found 0, expected positive"});
  check_says(slab(R"({"modes": [1, 2]})"), {"cases[0].parameters.modes[0]"});
  check_says(slab(R"({"modes": [[1, 2, 3]]})"), {"cases[0]", "modes"});
  check_says(slab(R"([1])"), {"cases[0].parameters"});
  check_says(refusal("cases", R"({"id": "operator/sine", "parameters": {"dimension": 4}})"),
             {"cases.parameters.dimension: found 4, expected 1, 2 or 3"});
  check_says(refusal("cases", R"({"id": "operator/sine", "parameters": {"dimension": 1.5}})"),
             {"cases.parameters.dimension: found 1.5, expected a whole number"});
  check_says(refusal("cases", R"({"id": "conduction/marshak", "parameters": {"final_time": 1000}})"),
             {"cases.parameters.final_time: found 1000 with the front at",
              "expected a time at which the front is inside"});
}

// ---- Moving gas

Json moving() {
  Json document = smallest();
  document["cases"] = "hydro/piston-velocity";
  document["formulations"] = "momentum/p-rho2";
  return document;
}

Study moving_with(std::string const& key, std::string const& value) {
  Json document = moving();
  document[key] = Json::parse(value);
  return read(document);
}

BOOST_AUTO_TEST_CASE(parameters_without_effect_are_refused_and_defaults_without_effect_not_written) {
  auto const tube = [](std::string const& parameters) {
    Json document = smallest();
    document["cases"] = Json::parse(R"([{"id": "hydro/riemann", "parameters": )" + parameters + "}]");
    document["formulations"] = "momentum/p-rho2";
    return document;
  };
  check_says(refusal(tube(R"({"preset": "sod", "gamma": 1.6666})")),
             {"study.json: cases[0].parameters.gamma: found 1.6666, expected none", "no effect"});
  check_says(refusal(tube(R"({"gamma": 1.4})")), {"cases[0].parameters.gamma: found 1.4", "no effect"});
  check_says(refusal(tube(R"({"preset": "sod", "left": [1, 0, 1], "right": [1, 0, 2]})")),
             {"cases[0].parameters.preset: found 'sod'", "no effect"});
  for (char const* parameters :
       {R"({"preset": "leblanc"})", R"({"left": [1, 0, 1], "right": [1, 0, 2], "gamma": 1.6})"}) {
    Study const study = read(tube(parameters));
    Json const written = to_json(study);
    BOOST_TEST(written["cases"][0]["parameters"].contains("gamma") ==
               study.cases[0].parameters.is_given("gamma"));
    BOOST_TEST(to_json(read(written)).dump() == written.dump());
  }
  Json driven = tube("{}");
  driven["envelope"] = Json::parse(R"({"parameter": "gamma", "from": 1.2, "to": 1.6})");
  check_says(refusal(driven), {"envelope.parameter: found 'gamma'", "no effect"});
}

BOOST_AUTO_TEST_CASE(a_moving_gas_has_defaults_of_its_own) {
  Study const study = read(moving());
  BOOST_TEST(study.densities == Words{"continuity"}, per_element());
  BOOST_TEST(study.integrators == Words{"auto"}, per_element());
  BOOST_TEST(study.smoothings == Words{"uniform"}, per_element());
  BOOST_TEST(study.wall_motions == Words{"velocity"}, per_element());
  BOOST_TEST(study.viscosities.size() == 1u);
  BOOST_TEST(!study.viscosities[0].has_value());
  BOOST_TEST(study.formulations[0].work == "");  // the partner is chosen where the runs are
}

BOOST_AUTO_TEST_CASE(a_study_of_gas_at_rest_and_in_motion_has_the_defaults_of_both) {
  Json document = moving();
  document["cases"] = {"hydro/uniform", "conduction/slab-dirichlet", "coupled/hot-wall"};
  Study const study = read(document);
  BOOST_TEST(study.densities == (Words{"given", "continuity"}), per_element());
  BOOST_TEST(study.integrators == (Words{"bdf", "auto"}), per_element());
  document["cases"] = {"coupled/hot-wall"};
  BOOST_TEST(read(document).densities == Words{"continuity"}, per_element());
  document["cases"] = {"operator/sine"};
  BOOST_TEST(read(document).densities == Words{"given"}, per_element());
  document["discretisation"] = {{"density", "summation"}, {"integrator", "leapfrog"}};
  BOOST_TEST(read(document).densities == Words{"summation"}, per_element());
  BOOST_TEST(read(document).integrators == Words{"leapfrog"}, per_element());
}

BOOST_AUTO_TEST_CASE(viscosity_is_automatic_off_or_two_coefficients) {
  Study const study = moving_with("viscosity", R"(["auto", "off", {"alpha": 0.5, "beta": 3}])");
  BOOST_TEST_REQUIRE(study.viscosities.size() == 3u);
  BOOST_TEST(!study.viscosities[0].has_value());
  BOOST_TEST((study.viscosities[1] == ViscosityChoice{0.0, 0.0}));
  BOOST_TEST((study.viscosities[2] == ViscosityChoice{0.5, 3.0}));
  BOOST_TEST(
      (moving_with("viscosity", R"({"alpha": 1, "beta": 0})").viscosities[0] == ViscosityChoice{1, 0}));
  BOOST_TEST((moving_with("discretisation", R"({"viscosity": "off"})").viscosities[0] == ViscosityChoice{}));
}

BOOST_AUTO_TEST_CASE(a_viscosity_that_makes_no_sense_is_refused) {
  check_says(refusal("viscosity", R"("on")"), {"study.json: viscosity: found 'on'", "auto, off"});
  check_says(refusal("viscosity", R"(["auto", "of"])"), {"viscosity[1]", "did you mean 'off'?"});
  check_says(refusal("viscosity", R"({"alpha": 1})"), {"viscosity.beta: found nothing"});
  check_says(refusal("viscosity", R"({"beta": 1})"), {"viscosity.alpha: found nothing"});
  check_says(refusal("viscosity", R"({"alpha": -1, "beta": 2})"), {"viscosity.alpha: found -1"});
  check_says(refusal("viscosity", R"({"alpha": 1, "beta": 1000})"), {"viscosity.beta: found 1000"});
  check_says(refusal("viscosity", R"({"alpha": "1", "beta": 2})"), {"viscosity.alpha: found '1'"});
  check_says(refusal("viscosity", R"({"alpha": 1, "beta": 2, "gamma": 3})"),
             {"viscosity.gamma: found an unknown key"});
  check_says(refusal("viscosity", "1"), {"viscosity: found 1"});
  check_says(refusal("viscosity", "[]"), {"viscosity: found an empty list"});
  check_says(refusal("viscosity", R"(["off", {"alpha": 0, "beta": 0}])"), {"viscosity[1]", "only once"});
  check_says(refusal("viscosity", R"(["auto", "auto"])"), {"viscosity[1]", "only once"});
}

BOOST_AUTO_TEST_CASE(smoothing_wall_motion_and_integrator_are_words) {
  BOOST_TEST(
      moving_with("smoothing", R"(["adaptive", "uniform"])").smoothings == (Words{"adaptive", "uniform"}),
      per_element());
  BOOST_TEST(
      moving_with("wall_motion", R"(["mass", "velocity"])").wall_motions == (Words{"mass", "velocity"}),
      per_element());
  BOOST_TEST(moving_with("discretisation", R"({"wall_motion": "mass"})").wall_motions == Words{"mass"},
             per_element());
  Words const integrators{"auto", "leapfrog", "runge-kutta", "bdf"};
  BOOST_TEST(
      moving_with("integrator", R"(["auto", "leapfrog", "runge-kutta", "bdf"])").integrators == integrators,
      per_element());
  check_says(refusal("smoothing", R"("adaptiv")"), {"smoothing", "did you mean 'adaptive'?"});
  check_says(refusal("smoothing", R"(["uniform", "uniform"])"), {"smoothing[1]", "only once"});
  check_says(refusal("wall_motion", R"("pressure")"), {"wall_motion: found 'pressure'", "velocity, mass"});
  check_says(refusal("integrator", R"("leapfrogg")"), {"integrator", "did you mean 'leapfrog'?"});
  check_says(refusal("closure", R"("quotients")"), {"closure", "did you mean 'quotient'?"});
}

BOOST_AUTO_TEST_CASE(choices_of_a_moving_gas_stand_in_one_place_only) {
  for (auto const& [key, value] : {std::pair<char const*, char const*>{"viscosity", "off"},
                                   {"smoothing", "uniform"},
                                   {"wall_motion", "mass"},
                                   {"integrator", "leapfrog"}}) {
    Json document = moving();
    document[key] = value;
    BOOST_TEST(refusal(document) == "");
    document["discretisation"] = {{key, value}};
    check_says(refusal(document), {"study.json: " + std::string(key), "either here or in discretisation"});
  }
}

BOOST_AUTO_TEST_CASE(a_study_of_moving_gas_written_down_reads_back_as_itself) {
  Json document = moving();
  document["cases"] =
      Json::parse(R"([{"id": "hydro/riemann", "parameters": {"left": [1, 0, 2], "right": [1, 0, 1]}},
                                      "hydro/piston-pressure"])");
  document["discretisation"] = Json::parse(
      R"({"viscosity": ["auto", "off", {"alpha": 0.5, "beta": 3}], "smoothing": ["adaptive", "uniform"],
          "wall_motion": ["mass", "velocity"], "integrator": ["auto", "leapfrog"], "closure": "quotient"})");
  document["measure"] = "energy-routes";
  Study const study = read(document);
  Json const written = to_json(study);
  Study const again = read(written);
  BOOST_TEST(written.dump() == to_json(again).dump());
  BOOST_TEST((again.viscosities == study.viscosities));
  BOOST_TEST((again.smoothings == study.smoothings));
  BOOST_TEST((again.wall_motions == study.wall_motions));
  BOOST_TEST((again.integrators == study.integrators));
  BOOST_TEST((again.cases[0].parameters == study.cases[0].parameters));
  BOOST_TEST((again.measure == MeasureSet{Measure::energy_routes}));
}

BOOST_AUTO_TEST_CASE(a_final_time_beyond_the_exact_solution_is_refused) {
  check_says(refusal("cases", R"({"id": "hydro/piston-velocity", "parameters": {"final_time": 1}})"),
             {"study.json: cases.parameters.final_time: found 1, expected less than",
              "the shock reaches the far wall"});
  check_says(refusal("cases", R"({"id": "hydro/uniform", "parameters": {"boundary": "free"}})"),
             {"cases.parameters.boundary: found 'free', expected one of"});
  check_says(refusal("cases", R"({"id": "hydro/riemann", "parameters": {"preset": "sodd"}})"),
             {"cases.parameters.preset: found 'sodd', expected one of"});
}

BOOST_AUTO_TEST_CASE(some_runs_of_a_study_written_down_read_back_as_themselves) {
  Json document = smallest();
  BOOST_TEST(!read(document).runs.has_value());
  BOOST_TEST(!to_json(read(document)).contains("runs"));
  document["runs"] = {0, 3, 17};
  Study const study = read(document);
  BOOST_TEST((study.runs.value() == std::vector<std::size_t>{0, 3, 17}));
  BOOST_TEST((read(to_json(study)).runs == study.runs));
}

/// Who merges parts has not the memory of those who ran them.
BOOST_AUTO_TEST_CASE(a_study_too_large_to_run_here_can_be_read_here) {
  Json document = smallest();
  document["cases"] = Json::parse(R"({"id": "conduction/slab-dirichlet", "parameters": {"dimension": 3}})");
  document["resolution"] = 100'000;
  Study const study = read(document);
  check_says(complaint([&] { require_memory(study, Node(document, "study.json")); }), {"study.json: resolution: found 100000", "GB"});
}

BOOST_AUTO_TEST_CASE(the_standard_studies_of_walls_and_closures_are_studies) {
  for (char const* name : {"hydro-walls-1d", "closures-1d", "cost-1d"}) {
    std::string const path = SPHVERIFY_SOURCE_DIR "/cases/studies/" + std::string(name) + ".json";
    Study const study = read_study(Node(read_json_file(path), path));
    BOOST_TEST(study.name == name);
  }
}

BOOST_AUTO_TEST_SUITE_END()
