// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <ctime>
#include <limits>

namespace sphverify::bench {

/// Times pass() again and again. The columns of Google Benchmark show means; the counters are of the fastest
/// pass, which neighbours on a shared machine disturb least:
///
///   ns_per_pair         processor time of all threads
///   wall_ns_per_pair    wall time
///   pairs_per_particle  directed pairs
///
/// One pass goes ahead untimed and makes what later ones reuse. Benchmarks that use this need
/// UseManualTime().
template <class Pass>
void time_passes(benchmark::State& state, std::size_t particles, std::size_t pairs, Pass const& pass) {
  pass();
  double fastest_wall = std::numeric_limits<double>::infinity();
  double fastest_processor = std::numeric_limits<double>::infinity();
  for (auto _ : state) {
    auto const start = std::chrono::steady_clock::now();
    std::clock_t const processor_start = std::clock();
    pass();
    benchmark::ClobberMemory();
    double const processor = static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC;
    double const wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    state.SetIterationTime(wall);
    fastest_wall = std::min(fastest_wall, wall);
    fastest_processor = std::min(fastest_processor, processor);
  }
  state.counters["ns_per_pair"] = 1e9 * fastest_processor / static_cast<double>(pairs);
  state.counters["wall_ns_per_pair"] = 1e9 * fastest_wall / static_cast<double>(pairs);
  state.counters["pairs_per_particle"] = static_cast<double>(pairs) / static_cast<double>(particles);
}

/// As above for what moves that many bytes per pass: the counter is GB_per_s of the fastest.
template <class Pass>
void time_transfers(benchmark::State& state, std::size_t bytes, Pass const& pass) {
  time_passes(state, 1, bytes, pass);
  double const ns_per_byte = state.counters["ns_per_pair"];
  state.counters.clear();
  state.counters["GB_per_s"] = 1.0 / ns_per_byte;
}

}  // namespace sphverify::bench
