// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/timing.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "harness/measure/machine.hpp"

namespace sphverify {

namespace {

constexpr double shortest_batch = 1e-3;
constexpr int largest_batch = 1 << 20;

bool is_narrow_to(MedianSeconds const& median, double spread) {
  return median.low && median.high && *median.high - *median.low < spread * *median.median;
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

MedianSeconds median_ratio(Cost const& time, Cost const& other) {
  if (time.occasion.empty() || time.occasion != other.occasion) return {};
  std::vector<double> ratios;
  std::size_t const rounds = std::min(time.round_seconds.size(), other.round_seconds.size());
  for (std::size_t n = 0; n < rounds; ++n) {
    if (!(other.round_seconds[n] > 0.0)) return {};
    ratios.push_back(time.round_seconds[n] / other.round_seconds[n]);
  }
  return median_of(std::move(ratios));
}

Repeats::Repeats(RepeatRule const& rule, std::function<std::optional<Cost>()> once,
                 std::function<bool()> out_of_time)
    : rule_(rule), once_(std::move(once)), out_of_time_(std::move(out_of_time)) {}

void Repeats::warm_up() { broken_ = !once_(); }

void Repeats::repeat() {
  std::optional<Cost> const again = once_();
  if (!again) {
    broken_ = true;
    return;
  }
  seconds_.push_back(again->seconds);
  spent_ += again->seconds * again->batch;
  // A command may wait for what it likes.
  busy_ = busy_ && again->cpu_seconds && again->is_counted() ? Number(*busy_ + *again->cpu_seconds) : std::nullopt;
  if (!fastest_ || again->seconds < fastest_->seconds) fastest_ = again;
}

bool Repeats::is_over() const {
  if (broken_) return true;
  if (seconds_.empty()) return false;
  return seconds_.size() >= static_cast<std::size_t>(rule_.most) ||
         (rule_.seconds > 0.0 && spent_ >= rule_.seconds) || out_of_time_();
}

bool Repeats::is_narrow() const {
  return !seconds_.empty() && seconds_.size() >= static_cast<std::size_t>(rule_.least) &&
         is_narrow_to(median_of(seconds_), rule_.spread);
}

std::optional<Cost> Repeats::cost() const {
  if (!fastest_) return std::nullopt;
  Cost cost = *fastest_;
  cost.machine = machine_name();
  cost.repeats = static_cast<int>(seconds_.size());
  cost.warm_up = true;
  cost.median = median_of(seconds_);
  double const wall = std::accumulate(seconds_.begin(), seconds_.end(), 0.0);
  if (busy_ && wall > 0.0) cost.busy = *busy_ / wall;
  return cost;
}

std::optional<Cost> time_repeats(RepeatRule const& rule, std::function<std::optional<Cost>()> const& once,
                                 std::function<bool()> const& out_of_time) {
  Repeats repeats(rule, once, out_of_time);
  while (!repeats.is_over() && !repeats.is_narrow()) repeats.repeat();
  return repeats.cost();
}

std::vector<std::optional<Cost>> take_turns(std::vector<Repeats>& runs, std::string const& occasion) {
  std::vector<Repeats*> active;
  for (Repeats& run : runs) active.push_back(&run);
  auto const narrow = [](Repeats const* run) { return run->is_narrow(); };
  while (true) {
    std::erase_if(active, [](Repeats const* run) { return run->is_over(); });
    if (std::all_of(active.begin(), active.end(), narrow)) break;  // none left among them
    for (Repeats* run : active) run->repeat();
    std::reverse(active.begin(), active.end());
  }
  std::vector<std::optional<Cost>> costs;
  for (Repeats const& run : runs) {
    costs.push_back(run.cost());
    if (!costs.back()) continue;
    costs.back()->occasion = occasion;
    costs.back()->round_seconds = run.seconds();
  }
  return costs;
}

int batch_for(std::function<double(int)> const& seconds_of) {
  int batch = 1;
  while (batch < largest_batch && seconds_of(batch) < shortest_batch) batch *= 2;
  return batch;
}

}  // namespace sphverify
