// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/json/lists_json.hpp"

#include <cmath>
#include <limits>

namespace sphverify {

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json number(Number const& value) { return value ? number(*value) : Json(nullptr); }

Json numbers(std::vector<double> const& values) {
  Json list = Json::array();
  for (double const value : values) list.push_back(number(value));
  return list;
}

Json number_lists(std::vector<std::vector<double>> const& lists) {
  Json all = Json::array();
  for (auto const& list : lists) all.push_back(numbers(list));
  return all;
}

double measured(Node const& node) {
  return node.is_null() ? std::numeric_limits<double>::quiet_NaN() : node.number();
}

std::vector<double> measured_list(Node const& node) {
  std::vector<double> values;
  for (Node const& element : node.elements()) values.push_back(measured(element));
  return values;
}

std::vector<std::vector<double>> measured_lists(Node const& node) {
  std::vector<std::vector<double>> lists;
  for (Node const& element : node.elements()) lists.push_back(measured_list(element));
  return lists;
}

Json to_json(Profile const& p) {
  Json json = {{"position", number_lists(p.position)},
               {"weight", numbers(p.weight)},
               {"regions", Json::object()},
               {"computed", Json::object()},
               {"exact", Json::object()}};
  for (auto const& [name, particles] : p.regions) json["regions"][name] = particles;
  for (auto const& [field, values] : p.computed) json["computed"][field] = number_lists(values);
  for (auto const& [field, values] : p.exact) json["exact"][field] = number_lists(values);
  return json;
}

Json to_json(History const& h, bool moves) {
  Json json = {{"time", numbers(h.time)}, {"energy", numbers(h.energy)}, {"exchanged", numbers(h.exchanged)}};
  if (!moves) return json;
  json["momentum"] = numbers(h.momentum);
  json["wall_impulse_defect"] = number_lists(h.wall_impulse_defect);
  json["wall_energy_defect"] = number_lists(h.wall_energy_defect);
  return json;
}

Profile read_profile(Node const& node) {
  Profile p;
  p.position = measured_lists(node.at("position"));
  // Documents of versions before 0.2 hold neither.
  if (auto const weight = node.find("weight")) p.weight = measured_list(*weight);
  if (auto const regions = node.find("regions")) {
    for (auto const& [name, particles] : regions->members()) {
      for (Node const& particle : particles.elements()) {
        p.regions[name].push_back(
            static_cast<std::uint64_t>(particle.integer(0, std::numeric_limits<std::int64_t>::max())));
      }
    }
  }
  for (auto const& [field, values] : node.at("computed").members())
    p.computed[field] = measured_lists(values);
  for (auto const& [field, values] : node.at("exact").members()) p.exact[field] = measured_lists(values);
  return p;
}

History read_history(Node const& node) {
  History h;
  h.time = measured_list(node.at("time"));
  h.energy = measured_list(node.at("energy"));
  h.exchanged = measured_list(node.at("exchanged"));
  if (auto const momentum = node.find("momentum")) h.momentum = measured_list(*momentum);
  if (auto const walls = node.find("wall_impulse_defect")) h.wall_impulse_defect = measured_lists(*walls);
  if (auto const walls = node.find("wall_energy_defect")) h.wall_energy_defect = measured_lists(*walls);
  return h;
}

}  // namespace sphverify
