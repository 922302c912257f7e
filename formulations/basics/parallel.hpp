// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "formulations/basics/fork_join.hpp"

namespace sphverify {

/// Where a thread carries out its loops with so many of them: one arena, since each new one has to gather its workers.
inline tbb::task_arena& arena_of(int threads) {
  thread_local std::map<int, tbb::task_arena> arenas;
  return arenas.try_emplace(threads, threads).first->second;
}

/// Calls block(begin, end) for parts of [0, count) that together are all of it. With several threads each
/// part is still the work of one, so that results do not depend on their number.
/// @param least how many are worth a task of their own
template <class Block>
void for_each_block(std::size_t count, int threads, Block const& block, std::size_t least = 1024) {
  if (threads <= 1 || count <= least) {
    if (count > 0) block(std::size_t{0}, count);
    return;
  }
  ForkJoin loop;
  arena_of(threads).execute([&] {
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

/// Joins of_block(begin, end) of blocks of [0, count) in their order, join(so_far, of_block). Blocks are of
/// one size whatever the number of threads, so that round-off does not depend on it either.
/// @param none what nothing at all gives, and what is begun with
template <class Value, class OfBlock, class Join>
Value joined_blocks(std::size_t count, int threads, Value const& none, OfBlock const& of_block,
                    Join const& join) {
  constexpr std::size_t block_size = 4096;
  std::size_t const blocks = (count + block_size - 1) / block_size;
  std::vector<Value> parts(blocks, none);
  for_each_block(
      blocks, threads,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b)
          parts[b] = of_block(b * block_size, std::min(count, (b + 1) * block_size));
      },
      1);
  Value all = none;
  for (Value& part : parts) join(all, part);
  return all;
}

/// zero + sum of term(i) over [0, count).
template <class Value, class Term>
Value sum_of_rows(std::size_t count, int threads, Value const& zero, Term const& term) {
  return joined_blocks(
      count, threads, zero,
      [&](std::size_t begin, std::size_t end) {
        Value sum = zero;
        for (std::size_t i = begin; i < end; ++i) sum += term(i);
        return sum;
      },
      [](Value& all, Value const& part) { all += part; });
}

/// The first i in [0, count) for which holds(i).
template <class Predicate>
std::optional<std::size_t> first_row(std::size_t count, int threads, Predicate const& holds) {
  return joined_blocks(
      count, threads, std::optional<std::size_t>(),
      [&](std::size_t begin, std::size_t end) -> std::optional<std::size_t> {
        for (std::size_t i = begin; i < end; ++i) {
          if (holds(i)) return i;
        }
        return std::nullopt;
      },
      [](std::optional<std::size_t>& first, std::optional<std::size_t> const& part) {
        if (!first) first = part;
      });
}

}  // namespace sphverify
