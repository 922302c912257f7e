// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/gate/measure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/gate/measuring.hpp"
#include "harness/gate/select.hpp"

namespace sphverify {

namespace {

using Fill = void (*)(Measuring&, Measured&);

Fill fill_of(GateMeasure measure) {
  switch (measure) {
    case GateMeasure::order:
      return measure_order;
    case GateMeasure::time_to_error:
      return measure_time_to_error;
    case GateMeasure::error:
      return measure_error;
    case GateMeasure::skill:
      return measure_skill;
    case GateMeasure::time_error:
      return measure_time_error;
    case GateMeasure::conservation:
      return measure_budget;
    case GateMeasure::wall_flux:
      return measure_wall_flux;
    case GateMeasure::stability:
      return measure_stability;
    case GateMeasure::cost:
      return measure_cost;
    case GateMeasure::status:
      break;
  }
  return [](Measuring&, Measured& m) { m.word = m.run->status; };
}

/// The selected runs of a series that the gate's level choice takes.
std::vector<RunRecord const*> levels(Measuring const& measuring, Series const& series) {
  Gate const& gate = measuring.gate;
  std::vector<RunRecord const*> selected;
  int finest = 0;
  for (std::size_t const index : series.runs) {
    RunRecord const& run = measuring.results.runs[index];
    if (!matches(gate.select, run) || measuring.is_reference(run.formulation)) continue;
    selected.push_back(&run);
    finest = std::max(finest, run.resolution);
  }
  if (gate.levels == LevelChoice::all) return selected;
  int const wanted = gate.levels == LevelChoice::one ? gate.resolution : finest;
  std::erase_if(selected, [&](RunRecord const* run) { return run->resolution != wanted; });
  return selected;
}

/// An entry for each run, or series, that the gate selects; nothing measured yet.
std::vector<Measured> subjects(Measuring const& measuring) {
  Gate const& gate = measuring.gate;
  std::vector<Measured> all;
  for (Series const& series : measuring.results.series) {
    if (is_of_series(gate.measure)) {
      if (matches(gate.select, series) && !measuring.is_reference(series.formulation))
        all.emplace_back().series = &series;
      continue;
    }
    for (RunRecord const* run : levels(measuring, series)) {
      all.emplace_back().series = &series;
      all.back().run = run;
    }
  }
  return all;
}

/// Why there can be no number: the run, or one of the series, is not ok.
std::string breakdown(Measuring const& measuring, Measured const& m) {
  if (m.run != nullptr) {
    // A spectrum is that of the scheme on its particles, whatever became of the run.
    GateMeasure const measure = measuring.gate.measure;
    bool const may_fail = measure == GateMeasure::status || measure == GateMeasure::stability;
    return m.run->status == "ok" || may_fail ? "" : failure(*m.run);
  }
  for (std::size_t const index : m.series->runs) {
    RunRecord const& run = measuring.results.runs[index];
    if (run.status != "ok") return fmt::format("at N = {} {}", run.resolution, failure(run));
  }
  return "";
}

std::vector<Measured> measure_all(Measuring measuring) {
  std::vector<Measured> all = subjects(measuring);
  Fill const fill = fill_of(measuring.gate.measure);
  bool any_sound = false;
  for (Measured& m : all) {
    m.problem = breakdown(measuring, m);
    if (!m.problem.empty()) continue;
    fill(measuring, m);
    any_sound = true;
  }
  if (any_sound) measuring.require_names();
  return all;
}

}  // namespace

bool is_of_series(GateMeasure measure) {
  return measure == GateMeasure::order || measure == GateMeasure::time_to_error;
}

std::vector<Measured> measure(Gate const& gate, Results const& results, std::string const& file) {
  return measure_all(Measuring(gate, results, &file));
}

std::vector<Measured> measure_baseline(Gate const& gate, Results const& baseline) {
  return measure_all(Measuring(gate, baseline, nullptr));
}

std::size_t count_selected(Gate const& gate, Results const& results) {
  return subjects(Measuring(gate, results, nullptr)).size();
}

}  // namespace sphverify
