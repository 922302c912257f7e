#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstddef>

#include "formulations/basics/fork_join.hpp"

namespace sphverify {

/// Calls block(begin, end) for parts of [0, count) that together are all of it. With several threads each
/// part is still the work of one, so that results do not depend on their number.
/// @param least how many are worth a task of their own
template <class Block>
void for_each_block(std::size_t count, int threads, Block const& block, std::size_t least = 1024) {
  if (threads <= 1) {
    if (count > 0) block(std::size_t{0}, count);
    return;
  }
  ForkJoin loop;
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, least), [&](auto const& rows) {
      ForkJoin::Part const part(loop);
      block(rows.begin(), rows.end());
    });
  });
}

/// Calls row(i) for i in [0, count).
template <class Row>
void for_each_row(std::size_t count, int threads, Row const& row) {
  for_each_block(count, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) row(i);
  });
}

}  // namespace sphverify
