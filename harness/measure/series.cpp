// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>

#include "cases/support/case.hpp"
#include "formulations/basics/parallel.hpp"
#include "formulations/rate_operator.hpp"
#include "harness/measure/allowed_order.hpp"
#include "harness/measure/order.hpp"
#include "reports/find_error.hpp"
#include "reports/mean_time.hpp"
#include "reports/timed_apart.hpp"

namespace sphverify {

namespace {

constexpr std::array<double, 3> relative_targets{0.1, 0.01, 0.001};
constexpr std::array<double, 2> resolution_targets{0.01, 0.001};  // whose N is looked for

struct NormChoice {
  char const* name;
  double NormSet::*norm;
};
constexpr std::array<NormChoice, 3> norm_choices{
    {{"l1", &NormSet::l1}, {"l2", &NormSet::l2}, {"linf", &NormSet::linf}}};

bool is_discontinuous(std::string const& case_id) {
  Case const* const found = find_case(case_id);
  return found != nullptr && found->info.discontinuous;
}

Discretisation without_seed(Discretisation d) {
  d.layout.seed = 0;
  return d;
}

bool same_ladder(Series const& series, RunRecord const& run) {
  return series.case_id == run.case_id && series.parameters == run.parameters &&
         series.formulation == run.formulation &&
         without_seed(series.discretisation) == without_seed(run.discretisation) &&
         series.smoothing_exponent == run.smoothing_exponent;
}

/// Runs of one series, by level from coarse to fine.
using Levels = std::vector<std::vector<RunRecord const*>>;

Levels levels_of(Series const& series, std::vector<RunRecord> const& runs) {
  std::map<int, std::vector<RunRecord const*>> by_resolution;
  for (std::size_t const index : series.runs) by_resolution[runs[index].resolution].push_back(&runs[index]);
  Levels levels;
  for (auto& [resolution, members] : by_resolution) levels.push_back(std::move(members));
  return levels;
}

void set_times(std::vector<RunRecord const*> const& members, SeriesLevel& level) {
  std::vector<Cost const*> costs;
  for (RunRecord const* run : members) costs.push_back(run->cost ? &*run->cost : nullptr);
  MeanTime const time = mean_time(costs);
  level.seconds = time.seconds;
  level.median = time.median;
}

Number standard_deviation(std::vector<double> const& values) {
  if (values.size() < 2) return std::nullopt;
  double const n = static_cast<double>(values.size());
  double const mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double sum = 0.0;
  for (double const v : values) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / (n - 1.0));
}

/// The exact field's norm, from the finest run that has one.
Number exact_norm(Levels const& levels, OrderEntry const& entry, NormChoice const& norm) {
  Number scale;
  for (auto const& level : levels) {
    for (RunRecord const* run : level) {
      if (RegionError const* found = find_error(*run, entry.field, entry.region))
        scale = found->scale.*norm.norm;
    }
  }
  return scale;
}

void set_resolution_targets(Levels const& levels, std::vector<LadderLevel> const& ladder,
                            NormChoice const& norm, OrderEntry& entry) {
  Number const scale = exact_norm(levels, entry, norm);
  LadderExtent const extent = extent_of(ladder, entry.levels.back().resolution * entry.levels.back().spacing);
  if (!scale || !(*scale > 0.0) || extent.finest == 0.0) return;
  for (double const relative : resolution_targets) {
    entry.observed.targets.push_back(resolution_for(entry.observed, relative * *scale, extent));
    entry.observed.targets.back().relative = relative;
  }
}

OrderEntry measure_order(Levels const& levels, std::string const& field, std::string const& region,
                         NormChoice const& norm) {
  double const allowed = allowed_of_ladder(levels, field, region).*norm.norm;
  OrderEntry entry{field, region, norm.name, allowed, {}, {}};
  std::vector<LadderLevel> ladder;
  LadderContext context{allowed, std::nullopt};
  for (auto const& level : levels) {
    LadderLevel step{level.front()->spacing, {}, 0.0};
    std::vector<std::string> failures;
    std::vector<double> means;
    for (RunRecord const* run : level) {
      RegionError const* error = find_error(*run, field, region);
      // An error that is no number is none, whatever the run says of itself.
      if (run->status != "ok" || error == nullptr || !std::isfinite(error->error.*norm.norm)) {
        failures.push_back(run->status);
        continue;
      }
      step.errors.push_back(error->error.*norm.norm);
      step.round_off = std::max(step.round_off, error->round_off);
      if (error->mean && std::isfinite(*error->mean)) means.push_back(*error->mean);
      if (run->integration && run->integration->time_error_share) {
        context.time_error_share =
            std::max(context.time_error_share.value_or(0.0), *run->integration->time_error_share);
      }
    }
    if (!failures.empty()) step.errors.clear();
    step.out_of_time =
        !failures.empty() && std::all_of(failures.begin(), failures.end(),
                                         [](auto const& status) { return status == "timed-out" || status == "failed" || status == "crashed"; });
    auto const average = [](std::vector<double> const& values) -> Number {
      if (values.empty()) return std::nullopt;
      return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    };
    Number const mean = average(step.errors);
    if (means.size() == step.errors.size()) step.mean = average(means);
    entry.levels.push_back({level.front()->resolution, step.spacing, static_cast<int>(level.size()), mean,
                            standard_deviation(step.errors), std::nullopt});
    entry.levels.back().mean = step.mean;
    ladder.push_back(std::move(step));
  }
  entry.observed = observed_order(ladder, context);
  bool const is_refined = levels.size() >= 3 && !ladder.back().out_of_time;
  if (allowed == 0.0 && is_refined && entry.observed.verdict != "diverging") {
    entry.observed.verdict = "floored";
    entry.observed.reason =
        fmt::format("the solution jumps in this region: its {} error cannot go down", norm.name);
  }
  set_resolution_targets(levels, ladder, norm, entry);
  return entry;
}

/// When the curve of error over run time first comes down to the entry's error; what the coarsest level
/// reached already is a bound.
void set_seconds(std::vector<SeriesLevel> const& levels, TimeToError& entry) {
  SeriesLevel const* before = nullptr;
  for (SeriesLevel const& level : levels) {
    if (!level.error || !level.seconds) {
      before = nullptr;
      continue;
    }
    if (*level.error <= entry.error) {
      entry.seconds = level.seconds;
      entry.median = level.median;
      entry.is_bound = before == nullptr || *level.error <= 0.0;
      if (entry.is_bound) return;
      double const part = std::log(*before->error / entry.error) / std::log(*before->error / *level.error);
      auto const between = [part](Number const& a, Number const& b) {
        return a && b ? Number(*a * std::pow(*b / *a, part)) : std::nullopt;
      };
      entry.seconds = between(before->seconds, level.seconds);
      // The time between two rises with both, so that its ends come from theirs.
      for (Number MedianSeconds::*const end :
           {&MedianSeconds::median, &MedianSeconds::low, &MedianSeconds::high}) {
        entry.median.*end = between(before->median.*end, level.median.*end);
      }
      return;
    }
    before = &level;
  }
}

void measure_times(Levels const& levels, NormChoice const& norm, OrderEntry& entry, Series& series) {
  for (std::size_t k = 0; k < levels.size(); ++k) set_times(levels[k], entry.levels[k]);
  Number const scale = exact_norm(levels, entry, norm);
  bool const timed = std::any_of(entry.levels.begin(), entry.levels.end(),
                                 [](SeriesLevel const& level) { return level.seconds.has_value(); });
  if (!timed || !scale || !(*scale > 0.0)) return;
  for (double const relative : relative_targets) {
    series.time_to_error.push_back(
        {entry.field, entry.region, entry.norm, relative, relative * *scale, std::nullopt, false});
    set_seconds(entry.levels, series.time_to_error.back());
  }
}

/// Orders and times of a series whose runs are known.
void measure(Series& series, std::vector<RunRecord> const& runs) {
  Levels const levels = levels_of(series, runs);
  std::set<std::pair<std::string, std::string>> measured;
  for (std::size_t const index : series.runs) {
    for (auto const& [field, by_region] : runs[index].errors) {
      for (auto const& [region, error] : by_region) measured.emplace(field, region);
    }
  }
  // A ladder of which every run failed still gets a verdict.
  if (measured.empty() && std::any_of(series.runs.begin(), series.runs.end(),
                                      [&](std::size_t index) { return runs[index].status != "ok"; })) {
    Case const* const found = find_case(series.case_id);
    bool const moving = !series.formulation.work.empty() || (found != nullptr && moves(found->info.kind));
    bool const is_rate = found != nullptr && found->info.kind == CaseKind::rates;
    SchemeInfo const* const scheme = find_scheme(series.formulation.id);
    std::string_view const field = is_rate && scheme ? info(output_field(scheme->rate)).name : moving ? "velocity" : "temperature";
    measured.emplace(field, "all");
  }
  for (auto const& [field, region] : measured) {
    for (NormChoice const& norm : norm_choices) {
      series.orders.push_back(measure_order(levels, field, region, norm));
      if (!series.is_timed_apart) measure_times(levels, norm, series.orders.back(), series);
    }
  }
}

}  // namespace

std::vector<Series> build_series(std::vector<RunRecord> const& runs, int threads) {
  std::vector<Series> all;
  bool const is_timed_apart = are_timed_apart(runs);
  for (std::size_t index = 0; index < runs.size(); ++index) {
    RunRecord const& run = runs[index];
    auto found = std::find_if(all.rbegin(), all.rend(), [&](Series const& s) { return same_ladder(s, run); });
    if (found == all.rend()) {
      Series series;
      series.case_id = run.case_id;
      series.discontinuous = is_discontinuous(run.case_id);
      series.label = run.label;
      series.parameters = run.parameters;
      series.formulation = run.formulation;
      series.discretisation = run.discretisation;
      series.is_timed_apart = is_timed_apart;
      series.smoothing_exponent = run.smoothing_exponent;
      all.push_back(std::move(series));
      found = all.rbegin();
    }
    found->runs.push_back(index);
  }
  for_each_block(
      all.size(), threads,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) measure(all[k], runs);
      },
      1);
  return all;
}

}  // namespace sphverify
