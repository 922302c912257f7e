#include "reports/html/page_series.hpp"

#include <cmath>
#include <map>

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
    auto const field = run.errors.find(entry.field);
    if (field == run.errors.end() || run.resolution <= finest) continue;
    auto const region = field->second.find(entry.region);
    if (region == field->second.end()) continue;
    finest = run.resolution;
    scale = norm_of(region->second.scale, entry.norm);
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
    } else if (run.cost) {
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

Json orders_json(Series const& series, std::vector<RunRecord> const& runs, Dictionary& word) {
  Json list = Json::array();
  for (OrderEntry const& entry : series.orders) {
    // Levels of all runs are listed beside; an entry's own may be fewer.
    std::map<int, SeriesLevel const*> by_resolution;
    for (std::size_t const index : series.runs) by_resolution[runs[index].resolution] = nullptr;
    for (SeriesLevel const& level : entry.levels) {
      if (auto const place = by_resolution.find(level.resolution); place != by_resolution.end())
        place->second = &level;
    }
    Json errors = Json::array();
    Json spreads = Json::array();
    bool spread_exists = false;
    for (auto const& [resolution, level] : by_resolution) {
      errors.push_back(level ? number(level->error) : Json(nullptr));
      spreads.push_back(level ? number(level->spread) : Json(nullptr));
      spread_exists = spread_exists || !spreads.back().is_null();
    }
    Json row = {word(entry.field),
                word(entry.region),
                word(entry.norm),
                entry.allowed,
                number(entry.observed.order),
                number(entry.observed.lower),
                number(entry.observed.upper),
                word(entry.observed.verdict),
                number(scale_of(series, runs, entry)),
                errors};
    if (spread_exists) row.push_back(spreads);
    list.push_back(std::move(row));
  }
  return list;
}

Json target_json(TimeToTarget const& target) {
  return {{"time", time_json(target.seconds, target.median)}, {"is_bound", target.is_bound}};
}

Json row_json(SeriesRow const& row) {
  return {{"field", row.field},
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
          {"wall_budget_defect", number(row.wall_budget_defect)},
          {"plateau_pressure", number(row.plateau_pressure)},
          {"wall_heating", number(row.wall_heating)},
          {"wall_impulse_defect", number(row.wall_impulse_defect)},
          {"momentum_drift", number(row.momentum_drift)},
          {"time_error_share", number(row.time_error_share)}};
}

}  // namespace

Json series_json(Series const& series, SeriesRow const& row, std::vector<RunRecord> const& runs,
                 Dictionary& word) {
  Json json = {{"case", word(series.case_id)}, {"parameters", word(row.parameters)}};
  put_formulation(json, series.formulation, series.label, word);
  json["settings"] = settings_json(series.discretisation, series.smoothing_exponent, word);
  json["row"] = row_json(row);
  json["levels"] = levels_json(series, runs, word);
  json["orders"] = orders_json(series, runs, word);
  return json;
}

}  // namespace sphverify::page
