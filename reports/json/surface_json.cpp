// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/json/surface_json.hpp"

#include <cmath>
#include "reports/json/checked_numbers.hpp"

#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json number(Number const& value) { return value ? number(*value) : Json(nullptr); }
Json words(std::string const& text) { return text.empty() ? Json(nullptr) : Json(text); }

Number read_number(Node const& node) { return node.is_null() ? Number() : Number(node.number()); }
std::string read_words(Node const& node) { return node.is_null() ? "" : node.string(); }
int read_count(Node const& node) { return static_cast<int>(node.integer(0, 1 << 30)); }

Json to_json(Estimate const& e) {
  return {{"value", number(e.value)},
          {"interval", e.lower ? Json::array({number(e.lower), number(e.upper)}) : Json(nullptr)}};
}

Estimate read_estimate(Node const& node) {
  Estimate e{read_number(node.at("value")), {}, {}};
  if (Node const interval = node.at("interval"); !interval.is_null()) {
    auto const ends = interval.elements();
    if (ends.size() != 2) interval.complain("two numbers");
    e.lower = read_number(ends[0]);
    e.upper = read_number(ends[1]);
    if (e.lower && e.upper && *e.lower > *e.upper)
      throw UserError(interval.file(), interval.key(), interval.json().dump(),
                      "[lower, upper], the lower end first");
  }
  return e;
}

Json to_json(SurfaceCell const& c) {
  return {{"resolution", c.resolution},   {"smoothing_ratio", number(c.smoothing_ratio)},
          {"spacing", number(c.spacing)}, {"particles", number(c.particles)},
          {"replicates", c.replicates},   {"error", number(c.error)},
          {"spread", number(c.spread)},   {"fitted", number(c.fitted)},
          {"seconds", number(c.seconds)}, {"pair_interactions", number(c.pair_interactions)}};
}

SurfaceCell read_cell(Node const& node) {
  return {read_count(node.at("resolution")), node.at("smoothing_ratio").number(),
          size_of(node.at("spacing")),       size_of(node.at("particles")),
          read_count(node.at("replicates")), optional_size(node.at("error")),
          optional_size(node.at("spread")),  read_number(node.at("fitted")),
          optional_size(node.at("seconds")), optional_size(node.at("pair_interactions"))};
}

Json to_json(SurfaceLaw const& law) {
  Json json = {{"unit", number(law.unit)},
               {"floor", number(law.floor)},
               {"smoothing_coefficient", number(law.smoothing_coefficient)},
               {"smoothing_exponent", number(law.smoothing_exponent)},
               {"sampling_coefficient", number(law.sampling_coefficient)},
               {"sampling_exponent", number(law.sampling_exponent)},
               {"spacing_exponent", number(law.spacing_exponent)},
               {"correlation", number(law.correlation)},
               {"sampling", Json::array()}};
  for (SamplingAtRatio const& s : law.sampling)
    json["sampling"].push_back({{"ratio", number(s.ratio)}, {"coefficient", number(s.coefficient)}});
  return json;
}

SurfaceLaw read_law(Node const& node) {
  SurfaceLaw law{node.at("unit").number(),
                 node.at("floor").number(),
                 node.at("smoothing_coefficient").number(),
                 node.at("smoothing_exponent").number(),
                 node.at("sampling_coefficient").number(),
                 node.at("sampling_exponent").number(),
                 node.at("spacing_exponent").number(),
                 node.at("correlation").number(),
                 {}};
  for (Node const& s : node.at("sampling").elements())
    law.sampling.push_back({s.at("ratio").number(), s.at("coefficient").number()});
  return law;
}

Json to_json(BestRatio const& b) {
  return {{"resolution", b.resolution},
          {"ratio", to_json(b.ratio)},
          {"edge", words(b.edge)},
          {"error", number(b.error)},
          {"grid_ratio", number(b.grid_ratio)},
          {"grid_error", number(b.grid_error)}};
}

BestRatio read_best(Node const& node) {
  return {read_count(node.at("resolution")),  read_estimate(node.at("ratio")),
          read_words(node.at("edge")),        read_number(node.at("error")),
          read_number(node.at("grid_ratio")), read_number(node.at("grid_error"))};
}

Json to_json(SurfacePath const& p) {
  Json json = {{"unit", p.cost.unit},
               {"cost",
                {{"coefficient", number(p.cost.coefficient)},
                 {"resolution_exponent", number(p.cost.resolution_exponent)},
                 {"ratio_exponent", number(p.cost.ratio_exponent)},
                 {"misfit", number(p.cost.misfit)}}},
               {"points", Json::array()},
               {"grid_exponent", number(p.grid_exponent)},
               {"rules", Json::array()},
               {"reason", words(p.reason)}};
  for (PathPoint const& point : p.points) {
    json["points"].push_back({{"error", number(point.error)},
                              {"N", number(point.resolution)},
                              {"ratio", to_json(point.ratio)},
                              {"cost", number(point.cost)},
                              {"edge", words(point.edge)}});
  }
  for (PathRule const& rule : p.rules) {
    json["rules"].push_back({{"exponent", number(rule.exponent)},
                             {"N", number(rule.resolution)},
                             {"ratio", number(rule.ratio)},
                             {"error", number(rule.error)},
                             {"error_ratio", to_json(rule.error_ratio)},
                             {"cost_ratio", to_json(rule.cost_ratio)},
                             {"remark", words(rule.remark)}});
  }
  return json;
}

SurfacePath read_path(Node const& node) {
  SurfacePath p;
  Node const cost = node.at("cost");
  p.cost = {node.at("unit").string(), cost.at("coefficient").number(),
            cost.at("resolution_exponent").number(), cost.at("ratio_exponent").number(),
            cost.at("misfit").number()};
  for (Node const& point : node.at("points").elements()) {
    p.points.push_back({point.at("error").number(), point.at("N").number(), read_estimate(point.at("ratio")),
                        point.at("cost").number(), read_words(point.at("edge"))});
  }
  p.grid_exponent = read_number(node.at("grid_exponent"));
  for (Node const& rule : node.at("rules").elements()) {
    p.rules.push_back({rule.at("exponent").number(), rule.at("N").number(), rule.at("ratio").number(),
                       rule.at("error").number(), read_estimate(rule.at("error_ratio")),
                       read_estimate(rule.at("cost_ratio")), read_words(rule.at("remark"))});
  }
  p.reason = read_words(node.at("reason"));
  return p;
}

Json to_json(SurfaceCandidate const& c) {
  return {{"model", c.model},
          {"parameters", c.parameters},
          {"criterion", number(c.criterion)},
          {"misfit", number(c.misfit)}};
}

template <typename Part>
Json list(std::vector<Part> const& parts) {
  Json all = Json::array();
  for (Part const& part : parts) all.push_back(to_json(part));
  return all;
}

void put_surface(Json& json, ErrorSurface const& e) {
  json["field"] = e.field;
  json["region"] = e.region;
  json["norm"] = e.norm;
  json["model"] = words(e.model);
  json["reason"] = e.reason;
  json["law"] = e.law ? to_json(*e.law) : Json(nullptr);
  json["misfit"] = number(e.misfit);
  json["smoothing_exponent"] = to_json(e.smoothing_exponent);
  json["sampling_exponent"] = to_json(e.sampling_exponent);
  json["spacing_exponent"] = to_json(e.spacing_exponent);
  json["neighbour_exponent"] = to_json(e.neighbour_exponent);
  json["best"] = list(e.best);
  json["paths"] = list(e.paths);
  json["candidates"] = list(e.candidates);
  json["cells"] = list(e.cells);
}

ErrorSurface read_error_surface(Node const& node) {
  ErrorSurface e;
  e.field = node.at("field").string();
  e.region = node.at("region").string();
  e.norm = node.at("norm").string();
  e.model = read_words(node.at("model"));
  e.reason = node.at("reason").string();
  if (Node const law = node.at("law"); !law.is_null()) e.law = read_law(law);
  e.misfit = read_number(node.at("misfit"));
  e.smoothing_exponent = read_estimate(node.at("smoothing_exponent"));
  e.sampling_exponent = read_estimate(node.at("sampling_exponent"));
  e.spacing_exponent = read_estimate(node.at("spacing_exponent"));
  e.neighbour_exponent = read_estimate(node.at("neighbour_exponent"));
  for (Node const& b : node.at("best").elements()) e.best.push_back(read_best(b));
  for (Node const& p : node.at("paths").elements()) e.paths.push_back(read_path(p));
  for (Node const& c : node.at("candidates").elements()) {
    e.candidates.push_back({c.at("model").string(), read_count(c.at("parameters")),
                            c.at("criterion").number(), c.at("misfit").number()});
  }
  for (Node const& c : node.at("cells").elements()) e.cells.push_back(read_cell(c));
  return e;
}

}  // namespace

Json to_json(Surface const& s) {
  Json json = {{"case", s.case_id}, {"parameters", parameters_json(s.parameters)}};
  put_formulation(json, s.formulation);
  json["label"] = s.label;
  json["discretisation"] = to_json(s.discretisation);
  // A surface runs over all h/dx and all seeds.
  json["discretisation"].erase("smoothing_ratio");
  if (json["discretisation"]["layout"].is_object()) json["discretisation"]["layout"].erase("seed");
  put_surface(json, s.error);
  return json;
}

Surface read_surface(Node const& node) {
  Surface s;
  s.case_id = node.at("case").string();
  s.parameters = read_parameters(node.at("parameters"));
  s.formulation = read_formulation(node);
  s.label = node.at("label").string();
  Node const discretisation = node.at("discretisation");
  Json with_ratio = discretisation.json();
  if (with_ratio.is_object()) with_ratio["smoothing_ratio"] = 1.0;
  s.discretisation = read_discretisation(Node(with_ratio, discretisation.file(), discretisation.key()));
  s.error = read_error_surface(node);
  return s;
}

}  // namespace sphverify
