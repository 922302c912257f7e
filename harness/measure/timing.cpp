#include "harness/measure/timing.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>

namespace sphverify {

namespace {

constexpr double shortest_batch = 1e-3;
constexpr int largest_batch = 1 << 20;

bool is_narrow(MedianSeconds const& median, double spread) {
  return median.low && median.high && *median.high - *median.low < spread * *median.median;
}

bool is_enough(RepeatRule const& rule, std::vector<double> const& seconds, double spent) {
  std::size_t const n = seconds.size();
  if (n == 0) return false;
  if (n >= static_cast<std::size_t>(rule.most)) return true;
  if (rule.seconds > 0.0 && spent >= rule.seconds) return true;
  return n >= static_cast<std::size_t>(rule.least) && is_narrow(median_of(seconds), rule.spread);
}

}  // namespace

std::size_t median_rank(std::size_t n) {
  // Either end misses the median if at most so many of n are on its other side.
  auto const missed = [n](std::size_t k) {
    return 2.0 * gsl_cdf_binomial_P(static_cast<unsigned>(k), 0.5, static_cast<unsigned>(n));
  };
  std::size_t rank = 0;
  for (std::size_t too_many = n; rank < too_many;) {
    std::size_t const middle = (rank + too_many) / 2;
    if (missed(middle) <= 0.05) {
      rank = middle + 1;
    } else {
      too_many = middle;
    }
  }
  return rank;
}

MedianSeconds median_of(std::vector<double> seconds) {
  std::size_t const n = seconds.size();
  if (n == 0) return {};
  std::sort(seconds.begin(), seconds.end());
  MedianSeconds found{0.5 * (seconds[(n - 1) / 2] + seconds[n / 2]), {}, {}};
  if (std::size_t const rank = median_rank(n); rank > 0) {
    found.low = seconds[rank - 1];
    found.high = seconds[n - rank];
  }
  return found;
}

std::optional<Cost> time_repeats(RepeatRule const& rule, std::function<std::optional<Cost>()> const& once,
                                 std::function<bool()> const& out_of_time) {
  std::optional<Cost> fastest;
  std::vector<double> seconds;
  double spent = 0.0;
  double wall = 0.0;
  Number busy = 0.0;  // processor time, until it is divided
  while (!is_enough(rule, seconds, spent) && (seconds.empty() || !out_of_time())) {
    std::optional<Cost> const again = once();
    if (!again) break;
    seconds.push_back(again->seconds);
    spent += again->seconds * again->batch;
    wall += again->seconds;
    busy = busy && again->cpu_seconds ? Number(*busy + *again->cpu_seconds) : std::nullopt;
    if (!fastest || again->seconds < fastest->seconds) fastest = again;
  }
  if (!fastest) return std::nullopt;
  fastest->repeats = static_cast<int>(seconds.size());
  fastest->warm_up = true;
  fastest->median = median_of(seconds);
  if (busy && wall > 0.0) fastest->busy = *busy / wall;
  return fastest;
}

int batch_for(std::function<double(int)> const& seconds_of) {
  int batch = 1;
  while (batch < largest_batch && seconds_of(batch) < shortest_batch) batch *= 2;
  return batch;
}

}  // namespace sphverify
