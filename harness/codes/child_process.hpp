// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace sphverify {

/// A program to start, and what it may take.
struct ChildCommand {
  std::vector<std::string> words;                  ///< the program, found as a shell finds it, and its arguments
  std::string folder;                              ///< where it runs, and which is watched for what it writes
  std::string output;                              ///< file for what it prints
  std::map<std::string, std::string> environment;  ///< beside ours
  double seconds = 0.0;                            ///< after which it is ended; 0: never
  std::uint64_t bytes = 0;                         ///< that the folder may hold; 0: any number
  std::atomic<bool> const* interrupted = nullptr;  ///< ends it likewise
};

struct ChildOutcome {
  enum class End { exited, signalled, not_started, out_of_time, out_of_space, interrupted };
  End end = End::not_started;
  int status = 0;  ///< exit status, number of the signal, or errno of what could not be started
  double seconds = 0.0, cpu_seconds = 0.0;  ///< from its start to its end; of it and all children that it waited for
  std::uint64_t peak_bytes = 0;             ///< most that it, or one of those, held in memory
};

/// Runs a program to its end. What it started is ended with it, whether it waited for it or not: its group, and all that carries
/// this run's mark in its environment. What has given up both is ended when no other command is under way. No shell is
/// involved. May be called by several threads. Throws std::runtime_error where no process can be made.
ChildOutcome run_child(ChildCommand const& command);

}  // namespace sphverify
