// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "bench/benchmarks.hpp"
#include "bench/hand_written.hpp"
#include "bench/passes.hpp"
#include "bench/sample.hpp"

namespace sphverify::bench {

namespace {

using namespace hand_written;

/// All that the loops read and write, for one cube.
struct Bench {
  explicit Bench(std::size_t side) : unsorted(make_sample(side)) {
    sort();
    build_rows_vectorised(cells, unsorted.reach(), rows);
    sorted = reordered(unsorted, cells.order);
    for (auto& component : rate) component.resize(sorted.size());
  }

  void sort() {
    sort_into_cells(unsorted.size(), unsorted.x.data(), unsorted.y.data(), unsorted.z.data(),
                    unsorted.reach(), cells);
  }
  /// Any numbers will do: the time does not depend on them. Made on demand, since they are half a gigabyte.
  double const* weights() {
    if (weight.size() < rows.neighbour.size()) {
      weight.resize(rows.neighbour.size());
      for (std::size_t k = 0; k < weight.size(); ++k) weight[k] = 1.0 + 0.001 * static_cast<double>(k % 97);
    }
    return weight.data();
  }

  Conduction conduction() const {
    Sample const& s = sorted;
    return {s.x.data(), s.y.data(), s.z.data(), s.m.data(), s.rho.data(), s.T.data(), s.K.data(), s.h};
  }
  Density density() const {
    return {sorted.x.data(), sorted.y.data(), sorted.z.data(), sorted.m.data(), sorted.h};
  }
  Euler euler() const {
    Sample const& s = sorted;
    return {s.x.data(),   s.y.data(), s.z.data(), s.vx.data(), s.vy.data(), s.vz.data(), s.m.data(),
            s.rho.data(), s.P.data(), s.c.data(), s.h,         1.0,         2.0};
  }
  EulerRates euler_rates() { return {rate[0].data(), rate[1].data(), rate[2].data(), rate[3].data()}; }

  Sample unsorted;
  Sample sorted;
  Cells cells;
  Rows rows;
  std::vector<double> weight;
  std::vector<double> records;
  std::vector<double> rate[4];
};

/// The cube of that side. One is kept: benchmarks are registered, and so run, side by side.
Bench& bench_of(std::size_t side) {
  static std::size_t kept_side = 0;
  static std::unique_ptr<Bench> kept;
  if (kept_side != side) {
    kept.reset();
    kept = std::make_unique<Bench>(side);
    kept_side = side;
  }
  return *kept;
}

struct Loop {
  char const* name;
  std::function<void(Bench&)> pass;
};

std::vector<Loop> const& list_loops() {
  static std::vector<Loop> const loops{
      {"sort", [](Bench& b) { b.sort(); }},
      {"list/scalar", [](Bench& b) { b.sort(), build_rows_scalar(b.cells, b.unsorted.reach(), b.rows); }},
      {"list/portable", [](Bench& b) { b.sort(), build_rows_portable(b.cells, b.unsorted.reach(), b.rows); }},
      {"list/vectorised",
       [](Bench& b) { b.sort(), build_rows_vectorised(b.cells, b.unsorted.reach(), b.rows); }},
  };
  return loops;
}

/// Those that compute something; each scalar one is followed by those that must agree with it.
std::vector<Loop> const& rate_loops() {
  static std::vector<Loop> const loops{
      {"conduction/scalar", [](Bench& b) { conduction_scalar(b.rows, b.conduction(), b.rate[0].data()); }},
      {"conduction/gathered",
       [](Bench& b) { conduction_gathered(b.rows, b.conduction(), b.rate[0].data()); }},
      {"conduction/vectorised",
       [](Bench& b) { conduction_vectorised(b.rows, b.conduction(), b.records, b.rate[0].data()); }},
      {"density/scalar", [](Bench& b) { density_scalar(b.rows, b.density(), b.rate[0].data()); }},
      {"density/vectorised",
       [](Bench& b) { density_vectorised(b.rows, b.density(), b.records, b.rate[0].data()); }},
      {"euler/scalar", [](Bench& b) { euler_scalar(b.rows, b.euler(), b.euler_rates()); }},
      {"euler/vectorised", [](Bench& b) { euler_vectorised(b.rows, b.euler(), b.records, b.euler_rates()); }},
      {"stored/scalar",
       [](Bench& b) { stored_scalar(b.rows, b.weights(), b.sorted.T.data(), b.rate[0].data()); }},
      {"stored/vectorised",
       [](Bench& b) { stored_vectorised(b.rows, b.weights(), b.sorted.T.data(), b.rate[0].data()); }},
      {"stored/gathered",
       [](Bench& b) { stored_gathered(b.rows, b.weights(), b.sorted.T.data(), b.rate[0].data()); }},
  };
  return loops;
}

void register_loops(std::vector<Loop> const& loops, std::size_t side) {
  for (Loop const& loop : loops) {
    std::string const name = std::string("hand-written/") + loop.name + "/" + std::to_string(side);
    benchmark::RegisterBenchmark(name.c_str(),
                                 [&loop, side](benchmark::State& state) {
                                   Bench& bench = bench_of(side);
                                   time_passes(state, bench.rows.size(), bench.rows.pairs(),
                                               [&] { loop.pass(bench); });
                                 })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }
}

/// Large enough for any cache; 1.2 GB in all.
constexpr std::size_t stream_size = 50'000'000;

void time_triad(benchmark::State& state) {
  std::vector<double> a(stream_size, 0.0), b(stream_size, 1.0), c(stream_size, 2.0);
  time_transfers(state, 3 * sizeof(double) * stream_size,
                 [&] { triad(stream_size, 3.0, b.data(), c.data(), a.data()); });
}

void time_sum(benchmark::State& state) {
  std::vector<double> a(stream_size, 1.0);
  time_transfers(state, sizeof(double) * stream_size,
                 [&] { benchmark::DoNotOptimize(hand_written::sum(stream_size, a.data())); });
}

/// Largest |a - b| relative to the largest |b|.
double difference(std::vector<double> const& a, std::vector<double> const& b) {
  double most = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    most = std::max(most, std::abs(a[i] - b[i]));
    largest = std::max(largest, std::abs(b[i]));
  }
  return most / largest;
}

}  // namespace

void register_hand_written(std::span<std::size_t const> sides) {
  benchmark::RegisterBenchmark("memory/triad", time_triad)->UseManualTime()->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("memory/sum", time_sum)->UseManualTime()->Unit(benchmark::kMillisecond);
  for (std::size_t const side : sides) {
    register_loops(list_loops(), side);
    register_loops(rate_loops(), side);
  }
}

std::string check_hand_written() {
  Bench bench(12);
  Rows expected;
  build_rows_scalar(bench.cells, bench.unsorted.reach(), expected);
  auto const used = [](Rows const& rows) { return std::span(rows.neighbour).first(rows.pairs()); };
  for (Loop const& loop : list_loops()) {
    if (loop.name == std::string("sort")) continue;  // makes no list
    loop.pass(bench);
    if (bench.rows.first != expected.first || !std::ranges::equal(used(bench.rows), used(expected)))
      return std::string(loop.name) + ": another list than list/scalar";
  }
  std::vector<double> scalar[4];
  for (Loop const& loop : rate_loops()) {
    loop.pass(bench);
    if (std::string(loop.name).ends_with("/scalar")) std::ranges::copy(bench.rate, scalar);
    for (std::size_t k = 0; k < 4; ++k) {
      // A component that the loop does not write is the same as before.
      double const found = difference(bench.rate[k], scalar[k]);
      if (!(found <= 1e-12 || scalar[k] == bench.rate[k])) {
        std::ostringstream message;
        message << loop.name << ": differs from the scalar loop by " << found << " of the largest value";
        return message.str();
      }
    }
  }
  return {};
}

}  // namespace sphverify::bench
