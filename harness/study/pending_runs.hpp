// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "harness/run/run.hpp"
#include "harness/study/journal.hpp"

namespace sphverify {

/// The runs of a study that are not in its results yet: measured one by one, timed in comparison groups. May
/// be asked by several threads; the runs of a group are timed by the one that measures the last of them.
class PendingRuns {
 public:
  /// What has become of a run.
  struct Finished {
    RunRecord record;
    double repeat_seconds = 0.0;  ///< wall time of its repeats, beside the measured run
  };

  /// @param specs all runs of the study; they and the options must outlive this
  /// @param journal null: none is kept
  PendingRuns(std::vector<RunSpec> const& specs, RunOptions const& options, Journal* journal);

  /// Announces a run that is to be carried out, before any is.
  void add(std::size_t index) { groups_[group_of_[index]].push_back(index); }

  /// Puts runs that take turns next to each other, so that none waits for long.
  void sort(std::vector<std::size_t>& indices) const;

  /// Measures a run (unless the journal has it) and, if it is the last of its group, times all of them; keeps
  /// the journal.
  /// @return what is finished now, by index: none, this one, or several. Throws Interrupted.
  std::map<std::size_t, Finished> carry_out(std::size_t index);

 private:
  /// Whether no other run that is to be carried out takes turns with it.
  bool is_alone(std::size_t index) const { return groups_[group_of_[index]].size() == 1; }
  MeasuredRun measure(std::size_t index);
  void time(std::vector<std::size_t> const& indices, std::map<std::size_t, Finished>& finished);

  std::vector<RunSpec> const& specs_;
  RunOptions const& options_;
  Journal* journal_;
  std::vector<std::size_t> group_of_;              ///< by run
  std::vector<std::vector<std::size_t>> groups_;   ///< announced runs, by group
  std::map<std::size_t, std::size_t> unmeasured_;  ///< by group, how many of its runs
  std::map<std::size_t, MeasuredRun> awaiting_;    ///< their timing, by run
  std::mutex mutex_;
};

}  // namespace sphverify
