// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/json/surface_json.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>

#include "reports/json/results_json.hpp"
#include "tests/support/documents.hpp"

BOOST_AUTO_TEST_SUITE(reports_json_surface_json)

using namespace sphverify;
using namespace sphverify::tests;

/// A surface with everything that one can have, no two numbers alike.
Surface full_surface() {
  Surface s;
  s.case_id = "conduction/slab-dirichlet";
  s.label = "conduction/brookshaw";
  s.parameters["left"] = 1.5;
  s.formulation = {"conduction/brookshaw", "", "", false};
  s.discretisation.layout = {"jittered", 0.15, 7};
  s.discretisation.density = "summation";
  ErrorSurface& e = s.error;
  e.field = "temperature";
  e.region = "all";
  e.norm = "l2";
  e.cells = {{25, 1.25, 0.04, 25.0, 5, 0.01, 0.002, 0.011, 0.5, 1234.0},
             {50, 1.5, 0.02, 50.0, 5, {}, {}, {}, {}, {}}};
  e.model = "smoothing and sampling";
  e.reason = "because";
  e.law = SurfaceLaw{0.02, 1e-5, 0.3, 2.1, 0.4, 3.2, 0.6, -0.25, {{1.25, 0.7}, {1.5, 0.8}}};
  e.misfit = 0.12;
  e.smoothing_exponent = {2.1, 1.9, 2.3};
  e.sampling_exponent = {3.2, 3.0, 3.4};
  e.spacing_exponent = {0.6, {}, {}};
  e.neighbour_exponent = {0.31, 0.21, 0.41};
  e.candidates = {{"smoothing and sampling", 5, 0.0, 0.12}, {"smoothing", 2, 33.0, 0.9}};
  e.best = {{25, {1.3, 1.2, 1.4}, "", 0.009, 1.25, 0.01}, {50, {}, "upper", {}, {}, {}}};
  SurfacePath path;
  path.cost = {"pair_interactions", 17.0, 2.2, 1.1, 0.05};
  path.points = {{0.01, 25.5, {1.31, 1.21, 1.41}, 900.0, "lower"}};
  path.grid_exponent = 0.35;
  path.rules = {{0.5, 50.0, 1.77, 0.02, {1.1, 1.0, 1.2}, {1.3, 1.15, 1.45}, "a remark"}};
  path.reason = "no reason";
  e.paths = {path};
  return s;
}

BOOST_AUTO_TEST_CASE(a_surface_is_read_back_as_it_was_written) {
  Json const written = to_json(full_surface());
  Surface const read = read_surface(Node(written, "f.json", "surfaces[0]"));
  BOOST_TEST(to_json(read) == written);
  // A key that neither writes would pass the line above.
  ErrorSurface const& e = read.error;
  BOOST_TEST(read.discretisation.density == "summation");
  BOOST_TEST(read.discretisation.layout.amplitude == 0.15);
  BOOST_TEST(!read.formulation.walls);
  BOOST_TEST((e.field == "temperature" && e.region == "all" && e.norm == "l2" && e.reason == "because"));
  BOOST_TEST((e.cells[0].pair_interactions == 1234.0 && e.cells[0].spread == 0.002 && !e.cells[1].error));
  BOOST_TEST((e.law->correlation == -0.25 && e.law->sampling[1].coefficient == 0.8 && e.law->unit == 0.02));
  BOOST_TEST((e.law->spacing_exponent == 0.6 && e.law->sampling_exponent == 3.2 && e.law->floor == 1e-5));
  BOOST_TEST((e.smoothing_exponent.upper == 2.3 && e.sampling_exponent.lower == 3.0));
  BOOST_TEST((e.spacing_exponent.value == 0.6 && !e.spacing_exponent.lower));
  BOOST_TEST((e.candidates[1].criterion == 33.0 && e.candidates[1].parameters == 2));
  BOOST_TEST((e.best[0].grid_error == 0.01 && e.best[1].edge == "upper" && !e.best[1].ratio.value));
  SurfacePath const& path = e.paths[0];
  BOOST_TEST((path.cost.unit == "pair_interactions" && path.cost.ratio_exponent == 1.1));
  BOOST_TEST((path.points[0].ratio.lower == 1.21 && path.points[0].edge == "lower"));
  BOOST_TEST(
      (path.grid_exponent == 0.35 && e.neighbour_exponent.upper == 0.41 && path.reason == "no reason"));
  BOOST_TEST((path.rules[0].cost_ratio.value == 1.3 && path.rules[0].error_ratio.upper == 1.2));
}

// Both sides of what is read back come from one writer: what it writes under each name is said here once more.
BOOST_AUTO_TEST_CASE(every_number_of_a_surface_stands_under_its_own_name) {
  Json const all = to_json(full_surface());
  BOOST_TEST(all["cells"][0] == Json::parse(R"({"resolution": 25, "smoothing_ratio": 1.25, "spacing": 0.04, "particles": 25,
    "replicates": 5, "error": 0.01, "spread": 0.002, "fitted": 0.011, "seconds": 0.5, "pair_interactions": 1234})"));
  BOOST_TEST(all["law"] == Json::parse(R"({"unit": 0.02, "floor": 1e-5, "smoothing_coefficient": 0.3,
    "smoothing_exponent": 2.1, "sampling_coefficient": 0.4, "sampling_exponent": 3.2, "spacing_exponent": 0.6,
    "correlation": -0.25, "sampling": [{"ratio": 1.25, "coefficient": 0.7}, {"ratio": 1.5, "coefficient": 0.8}]})"));
  BOOST_TEST(all["candidates"][1] == Json::parse(R"({"model": "smoothing", "parameters": 2, "criterion": 33, "misfit": 0.9})"));
  BOOST_TEST(all["best"][0] == Json::parse(R"({"resolution": 25, "ratio": {"value": 1.3, "interval": [1.2, 1.4]}, "edge": null,
    "error": 0.009, "grid_ratio": 1.25, "grid_error": 0.01})"));
  BOOST_TEST(all["paths"][0] == Json::parse(R"({"unit": "pair_interactions", "cost": {"coefficient": 17,
    "resolution_exponent": 2.2, "ratio_exponent": 1.1, "misfit": 0.05},
    "points": [{"error": 0.01, "N": 25.5, "ratio": {"value": 1.31, "interval": [1.21, 1.41]}, "cost": 900, "edge": "lower"}],
    "grid_exponent": 0.35,
    "rules": [{"exponent": 0.5, "N": 50, "ratio": 1.77, "error": 0.02, "error_ratio": {"value": 1.1, "interval": [1, 1.2]},
               "cost_ratio": {"value": 1.3, "interval": [1.15, 1.45]}, "remark": "a remark"}],
    "reason": "no reason"})"));
  BOOST_TEST(all["misfit"] == 0.12);
}

BOOST_AUTO_TEST_CASE(an_interval_need_not_hold_its_value_but_runs_upwards) {
  Json written = to_json(full_surface());
  written["smoothing_exponent"] = {{"value", 1.0}, {"interval", {1.2, 1.4}}};
  BOOST_TEST(*read_surface(Node(written, "f.json", "surfaces[0]")).error.smoothing_exponent.lower == 1.2);
  written["smoothing_exponent"]["interval"] = {1.4, 1.2};
  BOOST_CHECK_THROW(read_surface(Node(written, "f.json", "surfaces[0]")), UserError);
}

BOOST_AUTO_TEST_CASE(a_surface_names_neither_the_ratio_nor_the_seed_that_it_runs_over) {
  Json const json = to_json(full_surface());
  BOOST_TEST(!json["discretisation"].contains("smoothing_ratio"));
  BOOST_TEST(!json["discretisation"]["layout"].contains("seed"));
}

BOOST_AUTO_TEST_CASE(what_is_not_a_number_is_null_in_a_surface) {
  Surface s = full_surface();
  s.error.best[0].error = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(to_json(s)["best"][0]["error"].is_null());
}

BOOST_AUTO_TEST_CASE(documents_hold_surfaces_and_those_of_old_have_none) {
  TemporaryFolder const folder;
  std::string const path = folder.file("results.json");
  Results results;
  results.study = "{}";
  write_text(path, document_text(to_json(results)));
  BOOST_TEST(!to_json(results).contains("surfaces"));
  BOOST_TEST(read_results(path).surfaces.empty());
  results.surfaces = {full_surface()};
  write_text(path, document_text(to_json(results)));
  BOOST_TEST(to_json(read_results(path))["surfaces"] == to_json(results)["surfaces"]);
}

BOOST_AUTO_TEST_CASE(a_broken_surface_is_refused_with_its_key) {
  Json json = to_json(full_surface());
  json["cells"][1]["spacing"] = "x";
  BOOST_TEST(complaint([&] { read_surface(Node(json, "f.json", "surfaces[0]")); }) ==
             "f.json: surfaces[0].cells[1].spacing: found 'x', expected a number");
}

BOOST_AUTO_TEST_SUITE_END()
