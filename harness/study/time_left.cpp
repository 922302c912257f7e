// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/time_left.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "harness/study/memory.hpp"

namespace sphverify {

namespace {

struct Taken {
  double seconds = 0.0, work = 0.0;
  int runs = 0;

  void add(RunProgress const& run) {
    seconds += run.seconds;
    work += run.work;
    ++runs;
  }
  /// What as many runs of this mean time take for other work.
  double scaled_to(double other) const { return seconds / work * other; }
};

}  // namespace

double estimated_work(AnyProblem const& problem, LayoutChoice const& layout, int resolution, double support) {
  return estimated_pairs(problem, layout, resolution, support) * resolution;
}

std::optional<double> seconds_left(std::vector<RunProgress> const& runs, int at_a_time) {
  std::map<std::size_t, std::map<double, Taken>> by_kind;  // by work
  Taken all;
  for (RunProgress const& run : runs) {
    if (run.state != RunProgress::State::finished || !(run.work > 0.0)) continue;
    by_kind[run.kind][run.work].add(run);
    all.add(run);
  }
  if (all.runs == 0) return std::nullopt;
  auto const expected = [&](RunProgress const& run) {
    auto const kind = by_kind.find(run.kind);
    if (kind == by_kind.end()) return all.scaled_to(run.work);
    auto const nearest =
        std::min_element(kind->second.begin(), kind->second.end(), [&](auto const& a, auto const& b) {
          return std::abs(std::log(a.first / run.work)) < std::abs(std::log(b.first / run.work));
        });
    return nearest->second.scaled_to(run.work);
  };
  double sum = 0.0;
  double longest = 0.0;
  for (RunProgress const& run : runs) {
    bool const is_running =
        run.state == RunProgress::State::running || run.state == RunProgress::State::paused;
    if (!is_running && run.state != RunProgress::State::waiting) continue;
    if (!(run.work > 0.0)) continue;
    double const left = std::max(0.0, expected(run) - (is_running ? run.seconds : 0.0));
    sum += left;
    longest = std::max(longest, left);
  }
  // However many go on at once, no run is shared among them.
  return std::max(sum / std::max(1, at_a_time), longest);
}

std::string duration_text(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

}  // namespace sphverify
