#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "reports/json/node.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// Finished runs of a study under way, one line of JSON each, so that a killed study loses only the runs in
/// flight. The first line holds the study, so that a journal is never taken up by another one.
class Journal {
 public:
  /// Opens the journal of a study. With `resume` what it holds is kept, a line cut short by a kill dropped; a
  /// journal of another study throws UserError. Without, it starts afresh.
  Journal(std::string path, Json const& study, bool resume);
  ~Journal();
  Journal(Journal const&) = delete;
  Journal& operator=(Journal const&) = delete;

  /// Runs that were finished before, by their index in the study.
  std::map<std::size_t, RunRecord> const& finished() const { return finished_; }

  /// Appends a finished run and makes sure that it reached the disc. May be called by several threads.
  void append(std::size_t index, RunRecord const& run);

  /// Removes the journal: its study is complete.
  void remove();

 private:
  void write_line(std::string const& line);

  std::string path_;
  int file_ = -1;
  std::map<std::size_t, RunRecord> finished_;
  std::mutex mutex_;
};

}  // namespace sphverify
