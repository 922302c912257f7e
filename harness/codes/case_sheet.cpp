// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>

#include "harness/codes/initial_snapshot.hpp"
#include "harness/scene/place.hpp"
#include "reports/json/lists_json.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

constexpr int tabulated_times = 65;  // of what varies with time, the ends among them

template <int Dim>
Json list(Vector<Dim> const& v) {
  return std::vector<double>(v.begin(), v.end());
}
Json value_of(double value) { return number(value); }
template <int Dim>
Json value_of(Vector<Dim> const& value) {
  return list(value);
}

std::vector<double> times_until(double end) {
  std::vector<double> times;
  for (int k = 0; k < tabulated_times; ++k) times.push_back(end * k / (tabulated_times - 1));
  return times;
}

/// A number if it is always the same, else its values over the times.
template <class F>
Json over_time(double end, F const& f) {
  Json values = Json::array();
  bool is_constant = true;
  for (double const t : times_until(end)) {
    values.push_back(value_of(f(t)));
    is_constant = is_constant && values.back() == values.front();
  }
  return is_constant ? values.front() : Json{{"over_time", values}};
}

/// Whether what a wall prescribes differs from place to place along it.
template <int Dim, class F>
bool varies_along(Wall<Dim> const& wall, Domain<Dim> const& domain, double end, F const& f) {
  for (int k = 0; k < Dim; ++k) {
    Vector<Dim> const axis = domain.axes.col(k);
    if (std::abs(axis.dot(wall.outward_normal)) > 0.5) continue;
    for (double const part : {0.17, 0.41, 0.83}) {
      Vector<Dim> const there = wall.point + part * domain.extent()[k] * axis;
      for (double const t : {0.0, 0.37 * end, end}) {
        if (value_of(f(there, t)) != value_of(f(wall.point, t))) return true;
      }
    }
  }
  return false;
}

template <int Dim>
Json wall_json(Wall<Dim> const& wall, Domain<Dim> const& domain, double end) {
  Json json = {{"point", list(wall.point)}, {"outward_normal", list(wall.outward_normal)}, {"prescribes", Json::object()}};
  Json varying = Json::array();
  auto const put = [&](char const* name, auto const& f) {
    if (!f) return;
    json["prescribes"][name] = over_time(end, [&](double t) { return f(wall.point, t); });
    if (varies_along(wall, domain, end, f)) varying.push_back(name);
  };
  put("pressure", wall.pressure);
  put("velocity", wall.velocity);
  put("temperature", wall.temperature);
  put("conductivity", wall.conductivity);
  put("flux", wall.flux);
  if (!varying.empty()) json["varies_along_the_wall"] = varying;
  if (wall.path) json["place"] = over_time(end, wall.path);
  if (wall.heat_loss) json["loses_heat_to"] = wall.heat_loss->environment;
  return json;
}

template <int Dim>
Json sheet_of(Problem<Dim> const& problem, Discretisation const& d, int resolution, double smoothing_ratio) {
  Json walls = Json::array();
  for (Wall<Dim> const& wall : problem.walls) walls.push_back(wall_json(wall, problem.domain, problem.final_time));
  Json domain = {{"lower", list(problem.domain.lower)},
                 {"upper", list(problem.domain.upper)},
                 {"periodic", std::vector<bool>(problem.domain.periodic.begin(), problem.domain.periodic.end())}};
  if (problem.domain.is_turned()) {
    domain["axes"] = Json::array();
    for (int k = 0; k < Dim; ++k) domain["axes"].push_back(list<Dim>(problem.domain.axes.col(k)));
  }
  double const spacing = spacing_of(problem.domain, d.layout, resolution);
  Json json = {{"dimension", Dim},
               {"domain", domain},
               {"walls", walls},
               {"final_time", problem.final_time},
               {"gamma", problem.gamma > 0.0 ? Json(problem.gamma) : Json(nullptr)},
               {"driven_by", Json::array()},
               {"resolution", resolution},
               {"layout", to_json(d.layout)},
               {"kernel", d.kernel},
               {"spacing", spacing},
               {"smoothing_length", smoothing_ratio * spacing}};
  if (walls.dump().find("over_time") != std::string::npos) json["times"] = times_until(problem.final_time);
  if (problem.source) json["driven_by"].push_back("heat source");
  if (problem.body_force) json["driven_by"].push_back("body force");
  if (problem.point_energy) json["driven_by"].push_back("energy at a point, which the particles have");
  if (problem.conductivity) json["conductivity_depends_on_temperature"] = problem.conductivity_depends_on_temperature;
  return json;
}

}  // namespace

Json case_sheet(Case const& one, Parameters const& parameters, AnyProblem const& problem, Discretisation const& discretisation,
                int resolution, double smoothing_ratio) {
  Json json = {{"schema", "sphverify-particles/1"},
               {"case", {{"id", one.info.id}, {"parameters", parameters_json(parameters.all())}}}};
  json.update(std::visit(
      [&](auto const& p) { return sheet_of(p, discretisation, resolution, smoothing_ratio); }, problem));
  return json;
}

}  // namespace sphverify
