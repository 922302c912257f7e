// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/series_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/second_law_watched.hpp"

namespace sphverify {

namespace {

std::vector<std::pair<std::string, Number>> numbers_of(SeriesRow const& row) {
  return {{"error", row.error},
          {"relative_error", row.relative_error},
          {"order", row.order},
          {"order_half_width", row.half_width},
          {"order_low", row.lower},
          {"order_high", row.upper},
          {"floor", row.floor},
          {"floor_low", row.floor_low},
          {"floor_high", row.floor_high},
          {"resolution_of_1_percent", row.percent_target.resolution},
          {"wall_flux_error", row.wall_flux_error},
          {"energy_drift", row.energy_drift},
          {"wall_budget_defect", row.wall_budget_defect},
          {"seconds", row.seconds},
          {"median_seconds", row.median.median},
          {"low_seconds", row.median.low},
          {"high_seconds", row.median.high},
          {"busy", row.busy},
          {"seconds_to_1_percent", row.to_percent.seconds},
          {"median_seconds_to_1_percent", row.to_percent.median.median},
          {"low_seconds_to_1_percent", row.to_percent.median.low},
          {"high_seconds_to_1_percent", row.to_percent.median.high},
          {"seconds_to_1_permille", row.to_permille.seconds},
          {"median_seconds_to_1_permille", row.to_permille.median.median},
          {"low_seconds_to_1_permille", row.to_permille.median.low},
          {"high_seconds_to_1_permille", row.to_permille.median.high},
          {"time_error_share", row.time_error_share},
          {"plateau_pressure_error", row.plateau_pressure},
          {"shock_position_error", row.shock_position_error},
          {"wall_heating", row.wall_heating},
          {"wall_impulse_defect", row.wall_impulse_defect},
          {"momentum_drift", row.momentum_drift},
          {"energy_pair_drift", row.energy_pair_drift},
          {"energy_routes", row.energy_routes},
          {"energy_rounding", row.energy_rounding},
          {"momentum_pair_drift", row.momentum_pair_drift},
          {"momentum_rounding", row.momentum_rounding}};
}

/// Of what is only measured when asked for.
void add_stability(SeriesRow const& row, std::vector<std::pair<std::string, Number>>& numbers) {
  Stability const stability = row.stability.value_or(Stability{});
  auto const count = [](std::optional<std::uint64_t> n) { return n ? Number(*n) : Number(); };
  numbers.emplace_back("spectral_abscissa", stability.spectral_abscissa);
  numbers.emplace_back("spectral_radius", stability.spectral_radius);
  numbers.emplace_back("growing_modes", count(stability.growing_modes));
  numbers.emplace_back("unseen_modes", count(stability.unseen_modes));
  for (std::string const method : stable_step_methods) {
    auto const found = stability.stable_steps.find(method);
    StableStep const step = found == stability.stable_steps.end() ? StableStep{} : found->second;
    std::string name = "stable_step_" + method;
    std::replace(name.begin(), name.end(), '-', '_');
    numbers.emplace_back(name, step.measured);
    numbers.emplace_back(name + "_theory", step.theory);
  }
  auto const size = [&](Breach SecondLaw::*breach, bool (*was_watched)(SecondLaw const&)) {
    if (!row.second_law || !was_watched(*row.second_law)) return Number();
    return Number(((*row.second_law).*breach).size);
  };
  numbers.emplace_back("overshoot", size(&SecondLaw::overshoot, watched_bounds));
  numbers.emplace_back("undershoot", size(&SecondLaw::undershoot, watched_bounds));
  numbers.emplace_back("cold_to_hot", size(&SecondLaw::cold_to_hot, watched_cold_to_hot));
  numbers.emplace_back("smallest_entropy_production",
                       row.second_law ? row.second_law->smallest_entropy_production : Number());
}

std::vector<std::pair<std::string, Number>> all_numbers_of(SeriesRow const& row) {
  auto numbers = numbers_of(row);
  add_stability(row, numbers);
  return numbers;
}

std::vector<std::pair<std::string, std::string>> words_of(SeriesRow const& row) {
  std::vector<std::pair<std::string, std::string>> words{{"results", row.document},
                                                         {"case", row.case_id},
                                                         {"parameters", row.parameters},
                                                         {"formulation", row.formulation}};
  for (auto& choice : setting_words(row)) words.push_back(std::move(choice));
  words.insert(words.end(), {{"finest", fmt::format("{}", row.finest)},
                             {"field", row.field},
                             {"norm", row.norm},
                             {"verdict", row.verdict},
                             {"failures", row.failures}});
  return words;
}

}  // namespace

std::string series_csv(std::vector<SeriesRow> const& rows) {
  TextTable table;
  for (auto const& [name, value] : words_of(SeriesRow{})) table.header.push_back(name);
  for (auto const& [name, value] : all_numbers_of(SeriesRow{})) table.header.push_back(name);
  for (SeriesRow const& row : rows) {
    std::vector<std::string> cells;
    for (auto const& [name, value] : words_of(row)) cells.push_back(value);
    for (auto const& [name, value] : all_numbers_of(row))
      cells.push_back(value ? fmt::format("{}", *value) : "");
    table.rows.push_back(std::move(cells));
  }
  return render(table, {TableFormat::csv});
}

Json series_json(std::vector<SeriesRow> const& rows) {
  Json all = Json::array();
  for (SeriesRow const& row : rows) {
    Json entry;
    for (auto const& [name, value] : words_of(row)) entry[name] = value;
    for (auto const& [name, value] : all_numbers_of(row)) entry[name] = value ? Json(*value) : Json(nullptr);
    all.push_back(std::move(entry));
  }
  return all;
}

}  // namespace sphverify
