// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/html/page_surfaces.hpp"

#include "reports/table/setting.hpp"
#include "reports/table/surface_advice.hpp"

namespace sphverify::page {

namespace {

/// [value, lower, upper]
Json estimate_json(Estimate const& e) { return {number(e.value), number(e.lower), number(e.upper)}; }

Json law_json(SurfaceLaw const& law) {
  Json json = {{"floor", number(law.floor)},
               {"smoothing_coefficient", number(law.smoothing_coefficient)},
               {"smoothing_exponent", number(law.smoothing_exponent)},
               {"sampling_coefficient", number(law.sampling_coefficient)},
               {"sampling_exponent", number(law.sampling_exponent)},
               {"spacing_exponent", number(law.spacing_exponent)},
               {"correlation", number(law.correlation)},
               {"sampling", Json::array()}};
  for (SamplingAtRatio const& s : law.sampling)
    json["sampling"].push_back({number(s.ratio), number(s.coefficient)});
  return json;
}

Json path_json(SurfacePath const& path, Dictionary& word) {
  Json json = {{"unit", path.cost.unit},
               {"grid_exponent", number(path.grid_exponent)},
               {"reason", word.or_null(path.reason)},
               {"points", Json::array()},
               {"rules", Json::array()}};
  for (PathPoint const& p : path.points) {
    json["points"].push_back({number(p.error), number(p.resolution), estimate_json(p.ratio), number(p.cost)});
  }
  for (PathRule const& r : path.rules) {
    json["rules"].push_back({number(r.exponent), number(r.resolution), number(r.ratio), number(r.error),
                             estimate_json(r.error_ratio), estimate_json(r.cost_ratio),
                             word.or_null(r.remark)});
  }
  return json;
}

void put_error(Json& json, ErrorSurface const& e, Dictionary& word) {
  json["of"] = {word(e.field), word(e.region), word(e.norm)};
  json["model"] = word.or_null(e.model);
  json["reason"] = word.or_null(e.reason);
  json["law"] = e.law ? law_json(*e.law) : Json(nullptr);
  json["misfit"] = number(e.misfit);
  json["exponents"] = {estimate_json(e.smoothing_exponent), estimate_json(e.sampling_exponent),
                       estimate_json(e.spacing_exponent), estimate_json(e.neighbour_exponent)};
  json["best"] = Json::array();
  for (BestRatio const& b : e.best) {
    json["best"].push_back({b.resolution, estimate_json(b.ratio), word.or_null(b.edge), number(b.error),
                            number(b.grid_ratio), number(b.grid_error), word_of(advice_at(e, b))});
  }
  json["cells"] = Json::array();
  for (SurfaceCell const& c : e.cells) {
    json["cells"].push_back({c.resolution, number(c.smoothing_ratio), c.replicates, number(c.error),
                             number(c.spread), number(c.fitted), number(c.seconds)});
  }
  json["paths"] = Json::array();
  for (SurfacePath const& path : e.paths) json["paths"].push_back(path_json(path, word));
}

}  // namespace

Json surfaces_json(Results const& results, std::set<std::string> const& controls, Dictionary& word) {
  Json list = Json::array();
  for (Surface const& s : results.surfaces) {
    Json json = {{"case", word(s.case_id)}, {"parameters", word(parameters_text(s.parameters))}};
    put_formulation(json, s.formulation, s.label, word);
    // All h/dx of the grid belong to it.
    json["settings"] = settings_json(s.discretisation, 0.0, 0, word);
    json["settings"].erase("h/dx");
    json["is_control"] = !s.formulation.walls || controls.contains(s.formulation.id);
    put_error(json, s.error, word);
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace sphverify::page
