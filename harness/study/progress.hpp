// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include "harness/study/time_left.hpp"

namespace sphverify {

/// Progress of a study on standard error: a bar that redraws itself on a terminal, plain lines otherwise, as a log wants
/// them: after 5 s, and then ever more rarely. May be told by several threads.
class Progress {
 public:
  /// @param runs those taken over from a journal are finished before
  Progress(std::vector<RunProgress> runs, int at_a_time);
  ~Progress();

  void started(std::size_t run);
  /// A run waits for others to be as far as it is.
  void paused(std::size_t run);
  /// @param more_seconds what a paused run has taken since
  void finished(std::size_t run, std::string const& what, double more_seconds = 0.0);
  /// Time has passed, and perhaps no run has ended in it: says how things stand when it is time to. Call it about
  /// every second.
  void passed();

 private:
  void draw();

  using Time = std::chrono::steady_clock::time_point;
  std::vector<RunProgress> runs_;
  std::vector<Time> started_;
  int at_a_time_;
  std::size_t done_;
  bool terminal_;
  std::string last_{};  ///< the run that ended last
  Time start_, last_line_;
  std::mutex mutex_;
};

/// How long a log is silent between two lines of a study that has gone on for so long [s].
double seconds_between_lines(double seconds_so_far);

}  // namespace sphverify
