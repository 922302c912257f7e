#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace sphverify {

/// Progress of a study on standard error: a bar that redraws itself on a terminal, plain lines otherwise (at
/// most one every few seconds). May be told by several threads.
class Progress {
 public:
  /// @param done runs taken over from a journal
  Progress(std::size_t total, std::size_t done);
  ~Progress();

  void finished(std::string const& what);

 private:
  void draw(std::string const& what);

  using Time = std::chrono::steady_clock::time_point;
  std::size_t total_, done_, done_before_;
  bool terminal_;
  Time start_, last_line_;
  std::mutex mutex_;
};

}  // namespace sphverify
