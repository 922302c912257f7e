// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>

#include "bench/packs/rows.hpp"

namespace {

using namespace sphverify::bench;

struct Candidate {
  char const* name;
  Sweep sweep;
  bool runs_here;
};

}  // namespace

/// Prints ns per pair of every vector type, the fastest of rounds in turn, and its ratio to the first.
int main() {
  constexpr std::size_t side = 32;
  constexpr double dx = 1.0 / side, h = 1.2 * dx;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-0.1 * dx, 0.1 * dx), field(0.5, 1.5);
  std::size_t const count = side * side * side;
  std::unique_ptr<double, decltype(&std::free)> const records(
      static_cast<double*>(std::aligned_alloc(64, count * record * sizeof(double))), std::free);
  PackSample sample{records.get(), {0}, {}, h};
  auto const at = [](std::size_t i, std::size_t j, std::size_t k) { return (i * side + j) * side + k; };
  for (std::size_t n = 0; n < count; ++n) {
    double* const r = records.get() + n * record;
    std::size_t const place[3] = {n / (side * side), n / side % side, n % side};
    for (std::size_t k = 0; k < 3; ++k) r[k] = (static_cast<double>(place[k]) + 0.5) * dx + shift(random);
    for (std::size_t k = 3; k < record; ++k) r[k] = field(random);
    r[5] = 1.0 / r[4];
  }
  for (std::size_t n = 0; n < count; ++n) {
    double const* const own = records.get() + n * record;
    auto const range = [](std::size_t i) { return std::pair(i < 3 ? 0 : i - 3, i + 4 < side ? i + 4 : side); };
    auto const [i0, i1] = range(n / (side * side));
    auto const [j0, j1] = range(n / side % side);
    auto const [k0, k1] = range(n % side);
    for (std::size_t i = i0; i < i1; ++i)
      for (std::size_t j = j0; j < j1; ++j)
        for (std::size_t k = k0; k < k1; ++k) {
          double const* const other = records.get() + at(i, j, k) * record;
          double r2 = 0.0;
          for (std::size_t m = 0; m < 3; ++m) r2 += (own[m] - other[m]) * (own[m] - other[m]);
          if (r2 < 4.0 * h * h && other != own) sample.neighbour.push_back(static_cast<std::uint32_t>(at(i, j, k)));
        }
    sample.first.push_back(sample.neighbour.size());
  }
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
    std::fputs("error: this processor has no AVX2, for which all of them are compiled\n", stderr);
    return 3;
  }
  bool const has_avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                          __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
                          __builtin_cpu_supports("avx512cd");
  Candidate const candidates[] = {
      {"ours, 4", ours_of_four, true},    {"ours, 8", ours_of_eight, has_avx512},
#if SPHVERIFY_HAS_XSIMD
      {"xsimd, 4", xsimd_of_four, true},  {"xsimd, 8", xsimd_of_eight, has_avx512},
#endif
#if SPHVERIFY_HAS_HIGHWAY
      {"Highway, 4", highway_of_four, true}, {"Highway, 8", highway_of_eight, has_avx512},
#endif
  };
  constexpr std::size_t rounds = 40;
  std::vector<double> out(3 * count), reference(3 * count);
  double fastest[std::size(candidates)];
  std::fill(std::begin(fastest), std::end(fastest), 1e30);
  ours_of_four(sample, reference.data());
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t c = 0; c < std::size(candidates); ++c) {
      if (!candidates[c].runs_here) continue;
      auto const start = std::chrono::steady_clock::now();
      candidates[c].sweep(sample, out.data());
      double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      fastest[c] = std::min(fastest[c], seconds);
      double largest = 0.0, apart = 0.0;
      for (std::size_t n = 0; n < out.size(); ++n) {
        largest = std::max(largest, std::abs(reference[n]));
        apart = std::max(apart, std::abs(out[n] - reference[n]));
      }
      if (!(apart < 1e-12 * largest)) {
        std::fprintf(stderr, "error: %s differs by %g of %g\n", candidates[c].name, apart, largest);
        return 3;
      }
    }
  }
  double const pairs = static_cast<double>(sample.neighbour.size());
  std::printf("%zu particles, %.0f pairs each\n", count, pairs / static_cast<double>(count));
  for (std::size_t c = 0; c < std::size(candidates); ++c) {
    if (candidates[c].runs_here)
      std::printf("%-12s %6.3f ns per pair, %.3f of the first\n", candidates[c].name, 1e9 * fastest[c] / pairs,
                  fastest[c] / fastest[0]);
  }
}
