// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include "harness/study/time_left.hpp"

namespace sphverify {

/// Progress of a study on standard error: a bar that redraws itself on a terminal, plain lines otherwise (at
/// most one every few seconds). May be told by several threads.
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

 private:
  void draw(std::string const& what);

  using Time = std::chrono::steady_clock::time_point;
  std::vector<RunProgress> runs_;
  std::vector<Time> started_;
  int at_a_time_;
  std::size_t done_;
  bool terminal_;
  Time start_, last_line_;
  std::mutex mutex_;
};

}  // namespace sphverify
