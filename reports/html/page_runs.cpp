// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/html/page_runs.hpp"

#include <algorithm>
#include <cmath>

#include "reports/extremes.hpp"

namespace sphverify::page {

namespace {

Number relative(Number const& value, Budget const& budget) {
  double const scale = larger(std::abs(budget.initial), std::abs(budget.final));
  return value ? Number(std::abs(*value) / (scale > 0.0 ? scale : 1.0)) : Number();
}

}  // namespace

Json runs_json(Results const& results, std::vector<std::size_t> const& series_of, Dictionary& word) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < results.runs.size(); ++i) {
    RunRecord const& run = results.runs[i];
    Number flux_error, drift, defect;
    for (WallFlux const& wall : run.wall_flux) {
      if (!(wall.scale <= 0.0))
        flux_error = larger(flux_error.value_or(0.0), std::abs(wall.error) / wall.scale);
    }
    if (auto const energy = run.conservation.find("energy"); energy != run.conservation.end()) {
      drift = relative(energy->second.drift, energy->second);
      defect = relative(energy->second.wall_budget_defect, energy->second);
    }
    Cost const* cost = run.cost ? &*run.cost : nullptr;
    Stability const* stability = run.stability ? &*run.stability : nullptr;
    bool const has_seed = is_drawn(run.discretisation.layout);
    bool const has_series = series_of[i] < results.series.size();
    rows.push_back({has_series ? Json(series_of[i]) : Json(nullptr),
                    has_series ? Json(nullptr) : word(run.label),
                    has_series ? Json(nullptr) : word(run.case_id),
                    run.resolution,
                    run.particles,
                    has_seed ? Json(run.discretisation.layout.seed) : Json(nullptr),
                    word(run.status),
                    run.reason.empty() ? Json(nullptr) : word(run.reason),
                    number(run.smoothing_length),
                    cost ? time_json(cost->seconds, cost->median) : Json(nullptr),
                    cost && cost->is_counted() ? Json(cost->steps) : Json(nullptr),
                    cost && cost->is_counted() ? Json(cost->rate_evaluations) : Json(nullptr),
                    cost && cost->is_counted() ? Json(cost->pair_interactions) : Json(nullptr),
                    cost && cost->peak_bytes > 0 ? Json(cost->peak_bytes) : Json(nullptr),
                    number(drift),
                    number(defect),
                    number(flux_error),
                    run.integration ? number(run.integration->time_error_share) : Json(nullptr),
                    stability ? number(stability->spectral_abscissa) : Json(nullptr),
                    stability ? number(stability->spectral_radius) : Json(nullptr),
                    stability ? number(stability->largest_stable_step) : Json(nullptr)});
  }
  return {{"columns",
           {"series",
            "label",
            "case",
            "resolution",
            "particles",
            "seed",
            "status",
            "reason",
            "smoothing_length",
            "time",
            "steps",
            "rate_evaluations",
            "pair_interactions",
            "peak_bytes",
            "energy_drift",
            "wall_budget_defect",
            "wall_flux_error",
            "time_error_share",
            "spectral_abscissa",
            "spectral_radius",
            "largest_stable_step"}},
          {"rows", rows}};
}

std::vector<std::pair<std::size_t, std::size_t>> one_per_series(
    Results const& results, std::function<bool(RunRecord const&)> const& holds,
    std::function<double(RunRecord const&)> const& weight) {
  std::vector<std::pair<std::size_t, std::size_t>> chosen;
  for (std::size_t s = 0; s < results.series.size(); ++s) {
    RunRecord const* best = nullptr;
    std::size_t best_index = 0;
    for (std::size_t const index : results.series[s].runs) {
      RunRecord const& run = results.runs[index];
      if (!holds(run)) continue;
      bool const is_better = best == nullptr || run.resolution > best->resolution ||
                             (run.resolution == best->resolution && weight(run) > weight(*best));
      if (!is_better) continue;
      best = &run;
      best_index = index;
    }
    if (best != nullptr) chosen.emplace_back(s, best_index);
  }
  return chosen;
}

std::vector<std::size_t> finest_runs(Results const& results, Series const& series,
                                     std::function<bool(RunRecord const&)> const& holds) {
  std::vector<std::size_t> chosen;
  int finest = -1;
  for (std::size_t const index : series.runs) {
    RunRecord const& run = results.runs[index];
    if (!holds(run) || run.resolution < finest) continue;
    if (run.resolution > finest) chosen.clear();
    finest = run.resolution;
    chosen.push_back(index);
  }
  return chosen;
}

}  // namespace sphverify::page
