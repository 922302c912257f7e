// SPDX-License-Identifier: GPL-3.0-or-later
#include <benchmark/benchmark.h>

#include <charconv>
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "bench/benchmarks.hpp"

namespace {

/// Particles per side of the cubes, from a text like "40,100"; empty where it is no such text.
std::vector<std::size_t> parse_sides(std::string_view text) {
  std::vector<std::size_t> sides;
  char const* at = text.data();
  char const* const end = at + text.size();
  while (at < end) {
    std::size_t side = 0;
    auto const [next, error] = std::from_chars(at, end, side);
    if (error != std::errc{} || side < 3) return {};
    sides.push_back(side);
    if (next != end && *next != ',') return {};
    at = next + 1;
  }
  return sides;
}

}  // namespace

/// Environment SPHVERIFY_BENCH_SIDES: particles per side of the cubes to measure, "40,100" unless set.
int main(int argc, char** argv) {
  using namespace sphverify::bench;
  if (std::string const difference = check_hand_written(); !difference.empty()) {
    std::cerr << "error: " << difference << '\n';
    return 3;
  }
  char const* const wanted = std::getenv("SPHVERIFY_BENCH_SIDES");
  std::vector<std::size_t> const sides = parse_sides(wanted != nullptr ? wanted : "40,100");
  if (sides.empty()) {
    std::cerr << "error: SPHVERIFY_BENCH_SIDES: found \"" << wanted
              << "\", expected whole numbers of at least 3 with commas between\n";
    return 2;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  register_hand_written(sides);
  register_product(sides);
  register_line();
  register_scenes(sides);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
