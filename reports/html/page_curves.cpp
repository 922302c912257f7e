// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/html/page_curves.hpp"

#include <algorithm>
#include <cmath>

#include "reports/extremes.hpp"
#include "reports/html/page_runs.hpp"

namespace sphverify::page {

namespace {

// Numbers that a page may hold of each kind; with about 7 bytes each they leave room for the rest.
constexpr std::size_t most_profile_numbers = 120000;
constexpr std::size_t most_history_numbers = 40000;

double no_weight(RunRecord const&) { return 0.0; }

}  // namespace

Json profiles_json(Results const& results, std::size_t share) {
  auto const chosen = one_per_series(
      results, [](RunRecord const& run) { return run.profile.has_value(); }, no_weight);
  std::size_t per_point = 0;
  for (auto const& [series, index] : chosen) {
    Profile const& p = *results.runs[index].profile;
    per_point += (p.position.empty() ? 0 : p.position[0].size()) + 2 * p.computed.size();
  }
  std::size_t const points = points_each(most_profile_numbers / share, per_point);
  Json list = Json::array();
  for (auto const& [series, index] : chosen) {
    RunRecord const& run = results.runs[index];
    Profile const& p = *run.profile;
    auto const kept = spread_evenly(p.position.size(), points);
    Json json = {
        {"series", series}, {"run", index}, {"particles", p.position.size()}, {"position", Json::array()}};
    std::size_t const dimension = p.position.empty() ? 0 : p.position[0].size();
    for (std::size_t k = 0; k < dimension; ++k) json["position"].push_back(picked(p.position, k, kept));
    json["computed"] = Json::object();
    json["exact"] = Json::object();
    for (auto const& [field, values] : p.computed) json["computed"][field] = picked(values, 0, kept);
    for (auto const& [field, values] : p.exact) json["exact"][field] = picked(values, 0, kept);
    list.push_back(std::move(json));
  }
  return list;
}

Json histories_json(Results const& results, std::size_t share) {
  auto const chosen = one_per_series(
      results, [](RunRecord const& run) { return run.history.has_value(); }, no_weight);
  std::size_t per_point = 0;
  for (auto const& [series, index] : chosen) {
    History const& h = *results.runs[index].history;
    per_point += 4 + h.wall_impulse_defect.size() + h.wall_energy_defect.size();
  }
  std::size_t const points = points_each(most_history_numbers / share, per_point);
  Json list = Json::array();
  for (auto const& [series, index] : chosen) {
    RunRecord const& run = results.runs[index];
    History const& h = *run.history;
    auto const kept = spread_evenly(h.time.size(), points);
    Json json = {{"series", series},
                 {"run", index},
                 {"time", picked(h.time, kept)},
                 {"energy", picked(h.energy, kept)},
                 {"exchanged", picked(h.exchanged, kept)},
                 {"drift", Json::array()}};
    // Differences of nearly equal numbers are taken before rounding.
    if (auto const energy = run.conservation.find("energy"); energy != run.conservation.end()) {
      Budget const& b = energy->second;
      for (std::size_t const i : kept) {
        bool const exists = i < h.energy.size() && i < h.exchanged.size();
        json["drift"].push_back(exists ? number(h.energy[i] - b.initial - h.exchanged[i]) : Json(nullptr));
      }
      json["scale"] = number(larger(std::abs(b.initial), std::abs(b.final)));
    }
    if (!h.momentum.empty()) json["momentum"] = picked(h.momentum, kept);
    json["wall_impulse_defect"] = Json::array();
    json["wall_energy_defect"] = Json::array();
    for (auto const& wall : h.wall_impulse_defect) json["wall_impulse_defect"].push_back(picked(wall, kept));
    for (auto const& wall : h.wall_energy_defect) json["wall_energy_defect"].push_back(picked(wall, kept));
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace sphverify::page
