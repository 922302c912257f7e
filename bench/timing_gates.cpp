// SPDX-License-Identifier: GPL-3.0-or-later
// How often a gate on a ratio of run times is wrong, on a machine whose load changes: pairs of equal runs, of
// which no gate may say that they differ, and pairs of which one does 10% or 30% more work.
//
//   sphverify_timing_gates [PAIRS [LOAD]]
//
// PAIRS of each kind (20); LOAD is how many threads of other work come and go (one and a half a core; 0: none
// of ours).
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <random>
#include <thread>
#include <vector>

#include "harness/gate/judge.hpp"
#include "harness/gate/read_gates.hpp"
#include "harness/measure/series.hpp"
#include "harness/measure/timing.hpp"
#include "harness/run/run.hpp"

namespace {

using namespace sphverify;

/// Other work: threads that compute, or stream through memory, for a while and then sleep for a while.
class Load {
 public:
  explicit Load(int threads) {
    for (int k = 0; k < threads; ++k) {
      threads_.emplace_back([this, k] { work(static_cast<std::uint32_t>(k)); });
    }
  }
  ~Load() {
    over_ = true;
    for (std::thread& thread : threads_) thread.join();
  }
  Load(Load const&) = delete;
  Load& operator=(Load const&) = delete;

 private:
  void work(std::uint32_t seed) {
    std::mt19937 draw(seed);
    std::vector<double> memory(1 << 21, 1.0);  // 16 MiB
    std::exponential_distribution<double> seconds(2.0);
    double sum = 0.0;
    while (!over_) {
      auto const until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds(draw));
      bool const streams = draw() % 2 == 0;
      while (!over_ && std::chrono::steady_clock::now() < until) {
        for (std::size_t n = 0; n < (1 << 16); ++n)
          sum += memory[streams ? (n * 8191) % memory.size() : n % 64];
      }
      double const rest = seconds(draw);
      for (double slept = 0.0; slept < rest && !over_; slept += 0.01)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    sink_ = sum;
  }

  std::atomic<bool> over_{false};
  std::atomic<double> sink_{0.0};
  std::vector<std::thread> threads_;
};

RunSpec small_run() {
  Case const* const scene_case = find_case("conduction/slab-dirichlet");
  RunSpec spec{.scene_case = scene_case,
               .parameters = Parameters(scene_case->info.parameters),
               .formulation = {.id = "conduction/brookshaw", .work = "", .conduction = ""},
               .label = "conduction/brookshaw",
               .discretisation = {},
               .smoothing_exponent = 0.0,
               .resolution = 25,
               .smoothing_ratio = 1.2};
  return spec;
}

/// What one kind of pair came to.
struct Count {
  int slower = 0, faster = 0;    ///< the gate says that the first takes longer, or less long
  std::vector<double> widths{};  ///< of the intervals
};

class Trial {
 public:
  explicit Trial(RepeatRule const& rule) : spec_(small_run()) {
    options_.measure = {Measure::error, Measure::cost};
    options_.repeat = rule;
    run_ = measure_run(spec_, options_);
    run_.record.discretisation = spec_.discretisation;
  }

  /// The repeats of a run that does the same so many times over.
  Repeats times(int work) const {
    auto const one = std::make_shared<Repeats>(repeats_of(spec_, endless_, run_));
    auto const once = [one, work]() -> std::optional<Cost> {
      double const before = one->spent();
      for (int n = 0; n < work; ++n) one->repeat();
      Cost cost = *one->cost();
      cost.seconds = one->spent() - before;
      cost.cpu_seconds.reset();
      return cost;
    };
    return {options_.repeat, once, [] { return false; }};
  }

  static Cost alone(Repeats repeats) {
    while (!repeats.is_over() && !repeats.is_narrow()) repeats.repeat();
    return *repeats.cost();
  }

  /// Judges the ratio of two costs by the product's own gates.
  void judge_pair(Cost const& first, Cost const& second, Count& count) const {
    std::vector<RunRecord> runs(2, run_.record);
    runs[0].cost = first;
    runs[1].cost = second;
    runs[1].formulation.id = runs[1].label = "conduction/lucy-flux";
    Results results;
    results.runs = runs;
    results.series = build_series(runs);
    auto const fails = [&](char const* limit) {
      Json const gate = {{"name", "g"},
                         {"select", {{"formulation", "conduction/brookshaw"}}},
                         {"measure", "cost"},
                         {"quantity", "median_seconds"},
                         {"relative_to", "conduction/lucy-flux"},
                         {limit, 1.0}};
      Json const document = {{"schema", "sphverify-gates/1"}, {"gates", Json::array({gate})}};
      return judge(read_gates(Node(document, "gates")), results, {}).at(0).verdict == Verdict::failed;
    };
    count.slower += fails("maximum");
    count.faster += fails("minimum");
    MedianSeconds const ratio = median_ratio(first, second);
    double const crosswise =
        *first.median.high / *second.median.low - *first.median.low / *second.median.high;
    count.widths.push_back(ratio.low ? *ratio.high - *ratio.low : crosswise);
  }

 private:
  static RunOptions endless() {
    RunOptions options;
    options.measure = {Measure::error, Measure::cost};
    options.repeat.most = 1'000'000'000;
    return options;
  }

  RunSpec spec_;
  RunOptions options_, endless_ = endless();
  MeasuredRun run_;
};

int number(char const* text, int by_default) {
  return text == nullptr ? by_default : std::max(0, std::atoi(text));
}

}  // namespace

int main(int argc, char** argv) {
  int const pairs = number(argc > 1 ? argv[1] : nullptr, 20);
  int const cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  int const load = number(argc > 2 ? argv[2] : nullptr, (3 * cores + 1) / 2);
  constexpr int base = 10;  // a run is so many small ones, so that it may do 10% more
  fmt::print("{} pairs of each kind, {} threads of other work on {} cores\n", pairs, load, cores);
  fmt::print("{:<18}{:<34}{:>8}{:>8}{:>16}\n", "work", "timed", "slower", "faster", "median width");
  Load const other(load);
  Trial const trial({.most = 25, .least = 6, .spread = 0.02, .seconds = 2.0});
  for (int const work : {base, base + 1, base + 3}) {
    Count apart, crosswise, rounds;
    for (int n = 0; n < pairs; ++n) {
      Cost const first = Trial::alone(trial.times(work));
      trial.judge_pair(first, Trial::alone(trial.times(base)), apart);
      std::vector<Repeats> both{trial.times(work), trial.times(base)};
      auto costs = take_turns(both, "here");
      trial.judge_pair(*costs[0], *costs[1], rounds);
      for (auto& cost : costs) cost->occasion.clear();
      trial.judge_pair(*costs[0], *costs[1], crosswise);
    }
    auto const line = [&](char const* timed, Count const& count) {
      fmt::print("{:<18}{:<34}{:>8}{:>8}{:>16.3f}\n", fmt::format("{:+d}%", 10 * (work - base)), timed,
                 count.slower, count.faster, *median_of(count.widths).median);
    };
    line("one after the other", apart);
    line("in turn, medians", crosswise);
    line("in turn, round by round", rounds);
  }
}
