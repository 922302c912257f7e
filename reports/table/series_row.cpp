// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/series_row.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reports/extremes.hpp"
#include "reports/find_error.hpp"
#include "reports/leading_fields.hpp"
#include "reports/mean_time.hpp"
#include "reports/norm_of.hpp"
#include "reports/second_law_watched.hpp"

namespace sphverify {

namespace {

/// A number that is none stays.
void raise(Number& largest, double value) { largest = larger(largest.value_or(value), value); }

/// Keeps the one that is furthest from 0, with its sign.
void worsen(Number& worst, Number const& value) {
  if (!value) return;
  double const most = std::abs(worst.value_or(0.0));
  if (!worst || larger(std::abs(*value), most) != most) worst = value;
}

/// What sums of terms of that size, taken anew at every step, can be off by rounding: 64 epsilon as for
/// errors, growing as a random walk does.
double rounding_of(double size, RunRecord const& run) {
  double const steps = run.cost ? static_cast<double>(run.cost->steps) : 1.0;
  return 64.0 * std::numeric_limits<double>::epsilon() * std::sqrt(std::max(steps, 1.0)) * size;
}

void read_energy(RunRecord const& run, SeriesRow& row) {
  auto const found = run.conservation.find("energy");
  if (found == run.conservation.end()) return;
  Budget const& b = found->second;
  if (std::isnan(b.exchanged)) return;  // what crossed the walls is not known
  double const size = larger(std::abs(b.initial), std::abs(b.final));
  double const scale = size > 0.0 ? size : 1.0;
  raise(row.energy_drift, std::abs(b.drift) / scale);
  raise(row.energy_rounding, rounding_of(std::max(size, std::abs(b.exchanged)), run) / scale);
  if (b.pair_drift) {
    worsen(row.energy_pair_drift, *b.pair_drift / scale);
    worsen(row.energy_step_drift, (b.drift - *b.pair_drift) / scale);
  }
  if (b.wall_budget_defect) raise(row.wall_budget_defect, std::abs(*b.wall_budget_defect) / scale);
}

/// @param prescribed largest impulse that a wall prescribes
void read_momentum(RunRecord const& run, double prescribed, SeriesRow& row) {
  auto const mass = run.conservation.find("mass");
  auto const energy = run.conservation.find("energy");
  if (run.momentum.empty() || mass == run.conservation.end() || energy == run.conservation.end()) return;
  double const thermal = std::sqrt(2.0 * std::abs(mass->second.initial * energy->second.initial));
  double const scale = prescribed > 0.0 ? prescribed : thermal;
  if (scale == 0.0) return;
  for (Budget const& momentum : run.momentum) {
    if (std::isnan(momentum.exchanged)) return;
    worsen(row.momentum_drift, momentum.drift / scale);
    if (momentum.pair_drift) worsen(row.momentum_pair_drift, *momentum.pair_drift / scale);
  }
  raise(row.momentum_rounding, rounding_of(std::max(prescribed, thermal), run) / scale);
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
    for (std::size_t k = 0; k < wall.prescribed_impulse.size(); ++k) {
      scale = larger(scale, std::abs(wall.prescribed_impulse[k]));
      if (k < wall.impulse.size())
        defect = larger(defect, std::abs(wall.impulse[k] - wall.prescribed_impulse[k]));
    }
  }
  read_momentum(run, scale, row);
  if (scale > 0.0) worsen(row.wall_impulse_defect, defect / scale);
}

/// Whether a method can step less far than with another spectrum; what has no stable step can least.
bool is_shorter(StableStep const& a, StableStep const& b) {
  auto const length = [](StableStep const& s) { return s.measured ? *s.measured : s.theory.value_or(0.0); };
  return length(a) < length(b);
}

/// That a mode grows in one run is known of the row; that none does only if it is known of every run.
template <class T>
std::optional<T> larger_unless_unknown(std::optional<T> const& a, std::optional<T> const& b) {
  if (a && b) return std::max(a, b);
  std::optional<T> const& known = a ? a : b;
  return known && *known > T() ? known : std::nullopt;
}

void add_stability(Stability const& s, SeriesRow& row) {
  if (!row.stability) {
    row.stability = s;
    return;
  }
  Stability& worst = *row.stability;
  worst.spectral_abscissa = larger_unless_unknown(worst.spectral_abscissa, s.spectral_abscissa);
  worst.spectral_radius = larger_if_known(worst.spectral_radius, s.spectral_radius);
  worst.growing_modes = larger_unless_unknown(worst.growing_modes, s.growing_modes);
  if (!worst.worst_mode) worst.worst_mode = s.worst_mode;
  worst.unseen_modes = larger_if_known(worst.unseen_modes, s.unseen_modes);
  // The shortest of all is known where each is.
  std::erase_if(worst.stable_steps, [&](auto const& one) { return !s.stable_steps.contains(one.first); });
  for (auto& [method, shortest] : worst.stable_steps) {
    StableStep const& step = s.stable_steps.at(method);
    if (is_shorter(step, shortest)) shortest = step;
  }
}

/// Of the runs at the finest level. One that has none, where others have, knows nothing of its own modes.
void read_stability(std::vector<RunRecord const*> const& members, SeriesRow& row) {
  if (std::none_of(members.begin(), members.end(), [](RunRecord const* run) { return run->stability; }))
    return;
  for (RunRecord const* run : members) add_stability(run->stability.value_or(Stability{}), row);
}

void read_second_law(RunRecord const& run, SeriesRow& row) {
  if (!run.second_law) return;
  SecondLaw const& s = *run.second_law;
  if (!row.second_law) {
    row.second_law = s;
    return;
  }
  SecondLaw& worst = *row.second_law;
  // What one of the runs did not watch is not known of all.
  if (watched_bounds(worst) > watched_bounds(s) || watched_cold_to_hot(worst) > watched_cold_to_hot(s))
    worst.remark = s.remark;
  for (Breach SecondLaw::*const breach :
       {&SecondLaw::overshoot, &SecondLaw::undershoot, &SecondLaw::cold_to_hot}) {
    double const most = (worst.*breach).size;
    if (!std::isnan(most) && larger((s.*breach).size, most) != most) worst.*breach = s.*breach;
  }
  if (s.smallest_entropy_production &&
      s.smallest_entropy_production < worst.smallest_entropy_production.value_or(INFINITY)) {
    worst.smallest_entropy_production = s.smallest_entropy_production;
  }
}

void read_runs(Series const& series, std::vector<RunRecord> const& runs, SeriesRow& row) {
  std::string status;
  std::vector<RunRecord const*> members;
  int failed = 0;
  std::vector<Cost const*> timed;
  for (std::size_t const index : series.runs) {
    RunRecord const& run = runs[index];
    if (run.integration && run.integration->time_error_share) {
      raise(row.time_error_share, *run.integration->time_error_share);
    }
    if (run.cost && run.cost->busy) row.busy = std::min(row.busy.value_or(*run.cost->busy), *run.cost->busy);
    if (run.resolution != row.finest) continue;
    members.push_back(&run);
    if (run.status != "ok") {
      ++failed;
      status = run.status;
      continue;
    }
    if (run.integration && !run.integration->time_error_share) row.time_error_is_unknown = true;
    if (run.cost && !series.is_timed_apart) timed.push_back(&*run.cost);
    read_motion(run, row);
    for (WallFlux const& wall : run.wall_flux) {
      if (!(wall.scale <= 0.0)) raise(row.wall_flux_error, std::abs(wall.error) / wall.scale);
      row.heat_crosses_walls = row.heat_crosses_walls || std::abs(wall.exact) > 1e-9 * wall.scale;
    }
    read_energy(run, row);
    read_second_law(run, row);
  }
  read_stability(members, row);  // what fails has the most to say
  MeanTime const time = mean_time(timed);
  row.seconds = time.seconds;
  row.median = time.median;
  if (failed > 0) row.failures = fmt::format("{} {}/{}", status, failed, members.size());
}

/// What the fitted law says beyond the levels.
void read_law(ObservedOrder const& observed, SeriesRow& row) {
  if (observed.floor) {
    double const scale = row.error && row.relative_error ? *row.error / *row.relative_error : 1.0;
    row.floor = observed.floor->value / scale;
    row.floor_low = observed.floor->lower / scale;
    row.floor_high = observed.floor->upper / scale;
  }
  for (TargetResolution const& target : observed.targets) {
    if (target.relative && *target.relative == 0.01) row.percent_target = target;
  }
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
  row.reason = entry->observed.reason;
  row.order = entry->observed.order;
  row.lower = entry->observed.lower;
  row.upper = entry->observed.upper;
  if (row.lower && row.upper) row.half_width = 0.5 * (*row.upper - *row.lower);
  for (SeriesLevel const& level : entry->levels) {
    if (level.resolution != row.finest) continue;
    row.error = level.error;
    if (level.spread && level.replicates > 1) {
      double const n = level.replicates;
      row.seed_half_width = gsl_cdf_tdist_Pinv(0.975, n - 1.0) * *level.spread / std::sqrt(n);
    }
  }
  for (std::size_t const index : series.runs) {
    RegionError const* const error = find_error(runs[index], entry->field, region);
    if (!row.error || runs[index].resolution != row.finest || error == nullptr) continue;
    double const scale = norm_of(error->scale, norm);
    if (scale > 0.0) row.relative_error = *row.error / scale;
    raise(row.round_off, error->round_off);
  }
  read_law(entry->observed, row);
  for (TimeToError const& t : series.time_to_error) {
    if (t.field != row.field || t.region != region || t.norm != norm) continue;
    if (t.relative == 0.01) row.to_percent = {t.seconds, t.median, t.is_bound};
    if (t.relative == 0.001) row.to_permille = {t.seconds, t.median, t.is_bound};
  }
}

}  // namespace

SeriesRow series_row(NamedResults const& document, Series const& series, std::string const& region,
                     std::string const& norm, std::optional<int> resolution) {
  std::vector<RunRecord> const& runs = document.results.runs;
  SeriesRow row;
  static_cast<Setting&>(row) = setting_of(document.name, series);
  row.case_id = series.case_id;
  row.is_timed_apart = series.is_timed_apart;
  row.parameters = parameters_text(series.parameters);
  row.formulation = series.label;
  for (std::size_t const index : series.runs) {
    row.finest = std::max(row.finest, runs[index].resolution);
    row.first_resolution =
        std::min(row.first_resolution > 0 ? row.first_resolution : row.finest, runs[index].resolution);
  }
  row.finest = resolution.value_or(row.finest);
  read_runs(series, runs, row);
  row.discontinuous = series.discontinuous;
  std::string const by_case = series.discontinuous ? "l1" : "l2";
  read_order(series, runs, region, norm.empty() ? by_case : norm, row);
  return row;
}

std::vector<SeriesRow> series_rows(std::vector<NamedResults> const& documents, std::string const& region,
                                   std::string const& norm) {
  std::vector<SeriesRow> rows;
  for (NamedResults const& document : documents) {
    for (std::size_t k = 0; k < document.results.series.size(); ++k) {
      rows.push_back(series_row(document, document.results.series[k], region, norm));
      rows.back().index = k;
    }
  }
  return rows;
}

}  // namespace sphverify
