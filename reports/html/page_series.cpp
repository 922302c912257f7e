// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/html/page_series.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "reports/find_error.hpp"
#include "reports/mean_time.hpp"
#include "reports/norm_of.hpp"

namespace sphverify::page {

namespace {

/// The same norm of the exact field at the finest level that has it.
double scale_of(Series const& series, std::vector<RunRecord> const& runs, OrderEntry const& entry) {
  int finest = -1;
  double scale = 0.0;
  for (std::size_t const index : series.runs) {
    RunRecord const& run = runs[index];
    RegionError const* const error = find_error(run, entry.field, entry.region);
    if (error == nullptr || run.resolution <= finest) continue;
    finest = run.resolution;
    scale = norm_of(error->scale, entry.norm);
  }
  return scale;
}

Json levels_json(Series const& series, std::vector<RunRecord> const& runs, Dictionary& word) {
  struct Level {
    double spacing = NAN;
    int replicates = 0, failed = 0;
    std::string status;
    std::vector<Cost const*> timed;
  };
  std::map<int, Level> levels;
  for (std::size_t const index : series.runs) {
    RunRecord const& run = runs[index];
    Level& level = levels[run.resolution];
    level.spacing = run.spacing;
    ++level.replicates;
    if (run.status != "ok") {
      ++level.failed;
      level.status = run.status;
    } else if (run.cost && !series.is_timed_apart) {
      level.timed.push_back(&*run.cost);
    }
  }
  Json list = Json::array();
  for (auto const& [resolution, level] : levels) {
    MeanTime const time = mean_time(level.timed);
    list.push_back({resolution, number(level.spacing), level.replicates, level.failed,
                    level.failed > 0 ? word(level.status) : Json(nullptr),
                    time_json(time.seconds, time.median)});
  }
  return list;
}

/// [floor, coefficient, exponent, next coefficient, next exponent], as in ErrorLaw; null without a law.
Json law_json(std::optional<ErrorLaw> const& law) {
  if (!law) return nullptr;
  return {number(law->floor), number(law->coefficient), number(law->exponent), number(law->next_coefficient),
          number(law->next_exponent)};
}

/// [[relative, error, N, remark], ...]
Json targets_json(std::vector<TargetResolution> const& targets, Dictionary& word) {
  Json list = Json::array();
  for (TargetResolution const& target : targets) {
    list.push_back({number(target.relative), number(target.error), enough(target.resolution),
                    word.or_null(target.remark)});
  }
  return list;
}

/// The errors of an entry at all levels of the series; an entry's own may be fewer.
/// @return keys `errors`, and `spreads` and `means` where any level has one
Json entry_levels_json(Series const& series, std::vector<RunRecord> const& runs, OrderEntry const& entry) {
  std::map<int, SeriesLevel const*> by_resolution;
  for (std::size_t const index : series.runs) by_resolution[runs[index].resolution] = nullptr;
  for (SeriesLevel const& level : entry.levels) {
    if (auto const place = by_resolution.find(level.resolution); place != by_resolution.end())
      place->second = &level;
  }
  Json json = Json::object();
  auto const put = [&](char const* key, Number SeriesLevel::*value, bool always) {
    Json list = Json::array();
    bool exists = always;
    for (auto const& [resolution, level] : by_resolution) {
      list.push_back(level ? number(level->*value) : Json(nullptr));
      exists = exists || !list.back().is_null();
    }
    if (exists) json[key] = std::move(list);
  };
  put("errors", &SeriesLevel::error, true);
  put("spreads", &SeriesLevel::spread, false);
  put("means", &SeriesLevel::mean, false);
  return json;
}

Json orders_json(Series const& series, std::vector<RunRecord> const& runs, Dictionary& word) {
  Json list = Json::array();
  for (OrderEntry const& entry : series.orders) {
    ObservedOrder const& o = entry.observed;
    Json json = entry_levels_json(series, runs, entry);
    json["of"] = {word(entry.field), word(entry.region), word(entry.norm)};
    json["scale"] = number(scale_of(series, runs, entry));
    json["allowed"] = entry.allowed;
    json["order"] = {number(o.order), number(o.lower), number(o.upper)};
    json["verdict"] = word(o.verdict);
    json["reason"] = word.or_null(o.reason);
    if (!o.model.empty()) json["model"] = word(o.model);
    if (o.law) json["law"] = law_json(o.law);
    if (o.floor) json["floor"] = {number(o.floor->value), number(o.floor->lower), number(o.floor->upper)};
    if (!o.targets.empty()) json["targets"] = targets_json(o.targets, word);
    list.push_back(std::move(json));
  }
  return list;
}

Json target_json(TimeToTarget const& target) {
  return {{"time", time_json(target.seconds, target.median)}, {"is_bound", target.is_bound}};
}

Json row_json(SeriesRow const& row) {
  return {
      {"field", row.field},
      {"norm", row.norm},
      {"finest", row.finest},
      {"verdict", row.verdict},
      {"failures", row.failures},
      {"error", number(row.error)},
      {"relative_error", number(row.relative_error)},
      {"order", number(row.order)},
      {"half_width", number(row.half_width)},
      {"time", time_json(row.seconds, row.median)},
      {"to_percent", target_json(row.to_percent)},
      {"to_permille", target_json(row.to_permille)},
      {"wall_flux_error", number(row.wall_flux_error)},
      {"energy_drift", number(row.energy_drift)},
      {"energy_rounding", number(row.energy_rounding)},
      {"wall_budget_defect", number(row.wall_budget_defect)},
      {"plateau_pressure", number(row.plateau_pressure)},
      {"wall_heating", number(row.wall_heating)},
      {"wall_impulse_defect", number(row.wall_impulse_defect)},
      {"momentum_drift", number(row.momentum_drift)},
      {"time_error_share", number(row.time_error_share)},
      {"is_linearised", row.stability.has_value()},
      {"growing_modes",
       row.stability && row.stability->growing_modes ? Json(*row.stability->growing_modes) : Json(nullptr)}};
}

}  // namespace

Json series_json(Series const& series, SeriesRow const& row, std::vector<RunRecord> const& runs,
                 std::set<std::string> const& controls, Dictionary& word) {
  Json json = {{"case", word(series.case_id)}, {"parameters", word(row.parameters)}};
  put_formulation(json, series.formulation, series.label, word);
  int first_resolution = row.finest;
  for (std::size_t const run : series.runs)
    first_resolution = std::min(first_resolution, runs[run].resolution);
  json["settings"] = settings_json(series.discretisation, series.smoothing_exponent, first_resolution, word);
  json["is_control"] = !series.formulation.walls || controls.contains(series.formulation.id);
  json["row"] = row_json(row);
  json["levels"] = levels_json(series, runs, word);
  json["orders"] = orders_json(series, runs, word);
  return json;
}

}  // namespace sphverify::page
