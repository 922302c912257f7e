#include "reports/table/series_row.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/norm_of.hpp"

namespace sphverify {

namespace {

/// The field that a case is about.
constexpr std::array<char const*, 4> leading_fields{"temperature", "velocity", "acceleration", "heating"};

std::string parameters_text(std::map<std::string, ParameterValue> const& parameters) {
  std::vector<std::string> parts;
  for (auto const& [name, value] : parameters) {
    if (auto const* number = std::get_if<double>(&value))
      parts.push_back(fmt::format("{}={:g}", name, *number));
    if (auto const* word = std::get_if<std::string>(&value))
      parts.push_back(fmt::format("{}={}", name, *word));
    if (auto const* list = std::get_if<std::vector<double>>(&value))
      parts.push_back(fmt::format("{}={}", name, *list));
    if (auto const* table = std::get_if<std::vector<std::vector<double>>>(&value)) {
      parts.push_back(fmt::format("{}={}", name, *table));
    }
  }
  return fmt::format("{}", fmt::join(parts, " "));
}

void raise(Number& largest, double value) { largest = std::max(largest.value_or(value), value); }

/// Keeps the one that is furthest from 0, with its sign.
void worsen(Number& worst, Number const& value) {
  if (value && (!worst || std::abs(*value) > std::abs(*worst))) worst = value;
}

void read_motion(RunRecord const& run, SeriesRow& row) {
  for (ShockRecord const& shock : run.shocks) {
    worsen(row.plateau_pressure, shock.plateau_pressure);
    worsen(row.shock_position_error, shock.position_error);
  }
  if (run.motion) {
    worsen(row.wall_heating, run.motion->wall_heating);
    worsen(row.energy_routes, run.motion->energy_routes);
  }
  double scale = 0.0;
  double defect = 0.0;
  for (WallBudget const& wall : run.wall_budgets) {
    scale = std::max(scale, std::abs(wall.prescribed_impulse[0]));
    defect = std::max(defect, std::abs(wall.impulse[0] - wall.prescribed_impulse[0]));
  }
  if (scale == 0.0) return;
  worsen(row.wall_impulse_defect, defect / scale);
  for (Budget const& momentum : run.momentum) worsen(row.momentum_drift, momentum.drift / scale);
}

/// Empty if there are none, or one of them is empty.
template <class TimeOf>
Number mean_of(std::vector<Cost const*> const& costs, TimeOf const& time_of) {
  double sum = 0.0;
  for (Cost const* cost : costs) {
    Number const time = time_of(*cost);
    if (!time) return std::nullopt;
    sum += *time;
  }
  return costs.empty() ? Number() : Number(sum / static_cast<double>(costs.size()));
}

void read_runs(Series const& series, std::vector<RunRecord> const& runs, SeriesRow& row) {
  for (std::size_t const index : series.runs) row.finest = std::max(row.finest, runs[index].resolution);
  std::string status;
  int members = 0;
  int failed = 0;
  std::vector<Cost const*> timed;
  for (std::size_t const index : series.runs) {
    RunRecord const& run = runs[index];
    if (run.integration && run.integration->time_error_share) {
      raise(row.time_error_share, *run.integration->time_error_share);
    }
    if (run.cost && run.cost->busy) row.busy = std::min(row.busy.value_or(*run.cost->busy), *run.cost->busy);
    if (run.resolution != row.finest) continue;
    ++members;
    if (run.status != "ok") {
      ++failed;
      status = run.status;
      continue;
    }
    if (run.cost) timed.push_back(&*run.cost);
    read_motion(run, row);
    for (WallFlux const& wall : run.wall_flux) {
      if (wall.scale > 0.0) raise(row.wall_flux_error, std::abs(wall.error) / wall.scale);
      row.heat_crosses_walls = row.heat_crosses_walls || std::abs(wall.exact) > 1e-9 * wall.scale;
    }
    if (auto const energy = run.conservation.find("energy"); energy != run.conservation.end()) {
      Budget const& b = energy->second;
      double const scale = std::max(std::abs(b.initial), std::abs(b.final));
      raise(row.energy_drift, std::abs(b.drift) / (scale > 0.0 ? scale : 1.0));
      if (b.pair_drift) worsen(row.energy_pair_drift, *b.pair_drift / (scale > 0.0 ? scale : 1.0));
      if (b.wall_budget_defect) {
        raise(row.wall_budget_defect, std::abs(*b.wall_budget_defect) / (scale > 0.0 ? scale : 1.0));
      }
    }
  }
  row.seconds = mean_of(timed, [](Cost const& c) { return Number(c.seconds); });
  for (Number MedianSeconds::*const part :
       {&MedianSeconds::median, &MedianSeconds::low, &MedianSeconds::high}) {
    row.median.*part = mean_of(timed, [part](Cost const& c) { return c.median.*part; });
  }
  if (failed > 0) row.failures = fmt::format("{} {}/{}", status, failed, members);
}

void read_order(Series const& series, std::vector<RunRecord> const& runs, std::string const& region,
                std::string const& norm, SeriesRow& row) {
  OrderEntry const* entry = nullptr;
  for (char const* field : leading_fields) {
    for (OrderEntry const& candidate : series.orders) {
      if (entry == nullptr && candidate.field == field && candidate.region == region &&
          candidate.norm == norm) {
        entry = &candidate;
      }
    }
  }
  if (entry == nullptr) return;
  row.field = entry->field;
  row.norm = norm;
  row.verdict = entry->observed.verdict;
  row.order = entry->observed.order;
  if (entry->observed.lower && entry->observed.upper) {
    row.half_width = 0.5 * (*entry->observed.upper - *entry->observed.lower);
  }
  if (!entry->levels.empty()) row.error = entry->levels.back().error;
  for (std::size_t const index : series.runs) {
    auto const field = runs[index].errors.find(entry->field);
    if (!row.error || runs[index].resolution != row.finest || field == runs[index].errors.end()) continue;
    auto const found = field->second.find(region);
    if (found == field->second.end()) continue;
    double const scale = norm_of(found->second.scale, norm);
    if (scale > 0.0) row.relative_error = *row.error / scale;
  }
  for (TimeToError const& t : series.time_to_error) {
    if (t.field != row.field || t.region != region || t.norm != norm) continue;
    if (t.relative == 0.01) row.to_percent = {t.seconds, t.median, t.is_bound};
    if (t.relative == 0.001) row.to_permille = {t.seconds, t.median, t.is_bound};
  }
}

}  // namespace

std::vector<SeriesRow> series_rows(std::vector<NamedResults> const& documents, std::string const& region,
                                   std::string const& norm) {
  std::vector<SeriesRow> rows;
  for (NamedResults const& document : documents) {
    for (Series const& series : document.results.series) {
      SeriesRow row;
      row.document = document.name;
      row.case_id = series.case_id;
      row.parameters = parameters_text(series.parameters);
      row.formulation = series.label;
      row.walls = series.formulation.walls;
      row.choice = series.formulation;
      row.discretisation = series.discretisation;
      row.smoothing_exponent = series.smoothing_exponent;
      read_runs(series, document.results.runs, row);
      row.discontinuous = series.discontinuous;
      std::string const by_case = series.discontinuous ? "l1" : "l2";
      read_order(series, document.results.runs, region, norm.empty() ? by_case : norm, row);
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace sphverify
