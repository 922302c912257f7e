// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace sphverify {

/// Tells the thread sanitizer what TBB promises of a parallel loop, and what it cannot see, since the library
/// is not compiled with it: each part sees what was written before the loop, and after the loop all is seen
/// that the parts wrote. Of parts among each other it says nothing, so that their races are found. Made
/// before the loop, it outlives it. In all other builds it does nothing.
class ForkJoin {
 public:
  ForkJoin() { release(fork_); }
  ~ForkJoin() { acquire(join_); }
  ForkJoin(ForkJoin const&) = delete;
  ForkJoin& operator=(ForkJoin const&) = delete;

  /// Lives in the loop's body as long as that runs.
  class Part {
   public:
    explicit Part(ForkJoin& loop) : loop_(loop) { acquire(loop_.fork_); }
    ~Part() { release(loop_.join_); }
    Part(Part const&) = delete;
    Part& operator=(Part const&) = delete;

   private:
    ForkJoin& loop_;
  };

 private:
#if defined(__SANITIZE_THREAD__)
  static void acquire(char& tag) { __tsan_acquire(&tag); }
  static void release(char& tag) { __tsan_release(&tag); }
#else
  static void acquire(char&) {}
  static void release(char&) {}
#endif

  char fork_ = 0, join_ = 0;
};

}  // namespace sphverify
