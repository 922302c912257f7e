// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "harness/run/run.hpp"
#include "harness/study/open_file.hpp"
#include "reports/json/node.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// Finished runs of a study under way, one line of JSON each, so that a killed study loses only the runs in
/// flight (and of those that were being timed together, only their timing). The first line holds the study,
/// so that a journal is never taken up by another one.
class Journal {
 public:
  /// Opens the journal of a study. With `resume` what it holds is kept, a line cut short by a kill dropped; a
  /// journal of another study, or of another build (fingerprint), throws UserError. Without, it starts afresh.
  Journal(std::string path, Json const& study, bool resume);

  /// Throws UserError if what is known of a run is of another one: somebody edited the journal.
  void require_same(std::size_t index, RunSpec const& spec) const;

  /// Runs that were finished before, by their index in the study.
  std::map<std::size_t, RunRecord> const& finished() const { return finished_; }

  /// Runs that were measured before, but not yet timed.
  std::map<std::size_t, MeasuredRun> const& awaiting() const { return awaiting_; }

  /// Appends a run that is measured but awaits its timing.
  void append(std::size_t index, MeasuredRun const& run);

  /// Appends what runs cost that awaited their timing, all of them with one write: those that took turns are
  /// all finished or none of them is.
  void append(std::map<std::size_t, std::optional<Cost>> const& costs);

  /// Appends a finished run with one write, so that a kill cuts the last line at most. May be called by
  /// several threads.
  void append(std::size_t index, RunRecord const& run);

  /// The same of runs that took turns, all of them with one write.
  void append(std::map<std::size_t, RunRecord> const& runs);

  /// Removes the journal: its study is complete.
  void remove();

 private:
  void read_line(Json const& line);
  void write_lines(std::string const& lines);

  std::string path_;
  OpenFile file_;
  bool is_cut_ = false;  ///< it ends in half a line
  std::map<std::size_t, RunRecord> finished_;
  std::map<std::size_t, MeasuredRun> awaiting_;
  std::mutex mutex_;
};

}  // namespace sphverify
