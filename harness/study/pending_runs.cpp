// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/pending_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "harness/study/comparison_groups.hpp"

namespace sphverify {

namespace {

/// Names an occasion on which runs take turns as no other is named, on this machine or another.
std::string new_occasion() {
  std::random_device source;
  return fmt::format("{:08x}{:08x}", source(), source());
}

}  // namespace

PendingRuns::PendingRuns(std::vector<RunSpec> const& specs, RunOptions const& options, Journal* journal)
    : specs_(specs),
      options_(options),
      journal_(journal),
      group_of_(timing_groups(specs, options.measure, options.repeat)),
      groups_(specs.size()) {}

void PendingRuns::sort(std::vector<std::size_t>& indices) const {
  std::stable_sort(indices.begin(), indices.end(),
                   [&](std::size_t a, std::size_t b) { return group_of_[a] < group_of_[b]; });
}

MeasuredRun PendingRuns::measure(std::size_t index) {
  if (journal_ && journal_->awaiting().contains(index)) return journal_->awaiting().at(index);
  MeasuredRun run = measure_run(specs_[index], options_);
  // Where there is nobody to wait for the timing follows at once.
  if (journal_ && run.awaits_timing && !is_alone(index)) journal_->append(index, run);
  return run;
}

std::map<std::size_t, PendingRuns::Finished> PendingRuns::carry_out(std::size_t index) {
  if (options_.interrupted && *options_.interrupted) throw Interrupted();
  std::map<std::size_t, Finished> finished;
  MeasuredRun run = measure(index);
  if (!run.awaits_timing) {
    if (journal_) journal_->append(index, run.record);
    finished[index] = {std::move(run.record), 0.0};
  }
  std::size_t const group = group_of_[index];
  std::vector<std::size_t> to_time;
  {
    std::scoped_lock const lock(mutex_);
    if (run.awaits_timing) awaiting_[index] = std::move(run);
    if (--unmeasured_.try_emplace(group, groups_[group].size()).first->second > 0) return finished;
    std::copy_if(groups_[group].begin(), groups_[group].end(), std::back_inserter(to_time),
                 [&](std::size_t k) { return awaiting_.contains(k); });
  }
  if (!to_time.empty()) time(to_time, finished);
  return finished;
}

void PendingRuns::time(std::vector<std::size_t> const& indices, std::map<std::size_t, Finished>& finished) {
  std::vector<MeasuredRun> runs;
  {
    std::scoped_lock const lock(mutex_);
    for (std::size_t const k : indices) runs.push_back(std::move(awaiting_.extract(k).mapped()));
  }
  std::vector<Repeats> repeats;
  for (std::size_t n = 0; n < runs.size(); ++n) {
    repeats.push_back(repeats_of(specs_[indices[n]], options_, runs[n]));
    // Another process measured it: nothing is warm.
    if (journal_ && journal_->awaiting().contains(indices[n])) repeats.back().warm_up();
  }
  auto const costs = take_turns(repeats, runs.size() > 1 ? new_occasion() : "");
  std::map<std::size_t, std::optional<Cost>> by_run;
  for (std::size_t n = 0; n < runs.size(); ++n) by_run[indices[n]] = costs[n];
  if (journal_ && !is_alone(indices.front())) journal_->append(by_run);
  for (std::size_t n = 0; n < runs.size(); ++n) {
    put_cost(runs[n], costs[n]);
    if (journal_ && is_alone(indices[n])) journal_->append(indices[n], runs[n].record);
    finished[indices[n]] = {std::move(runs[n].record), repeats[n].spent()};
  }
}

}  // namespace sphverify
