// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/time_ratio.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace sphverify {

namespace {

/// Below it the machine was disturbed; a run alone on its core waits for nothing.
constexpr double least_busy = 0.95;

/// It got there on its way to larger errors.
bool diverges(SeriesRow const& row) { return row.verdict == "diverging"; }

/// What is compared: one slow repeat moves a mean, one lucky repeat a minimum, neither of them the median.
Number typical(TimeToTarget const& time) { return time.median.median ? time.median.median : time.seconds; }

/// "1.09±0.05" where the ends are within 10%, by the further one; else "2.4 (1.9-3.1)".
std::string with_interval(double ratio, double low, double high) {
  double const half = std::max(high - ratio, ratio - low);
  if (half < 0.1 * ratio) {
    int const decimals = ratio < 10.0 ? 2 : 1;
    double const unit = std::pow(10.0, -decimals);
    return fmt::format("{:.{}f}±{:.{}f}", ratio, decimals, unit * std::ceil(half / unit), decimals);
  }
  auto const digits = [](double x) { return fmt::format("{:.{}f}", x, x < 9.95 ? 1 : 0); };
  return fmt::format("{} ({}-{})", digits(ratio), digits(low), digits(high));
}

}  // namespace

std::optional<TimeRatio> time_ratio(TimeToTarget const& time, TimeToTarget const& other) {
  bool const by_median = time.median.median && other.median.median;
  Number const own = by_median ? time.median.median : time.seconds;
  Number const its = by_median ? other.median.median : other.seconds;
  if (!own || !its || !(*its > 0.0)) return std::nullopt;
  TimeRatio ratio{*own / *its, {}, {}};
  if (by_median && time.median.low && time.median.high && other.median.low && other.median.high &&
      *other.median.low > 0.0) {
    ratio.low = *time.median.low / *other.median.high;
    ratio.high = *time.median.high / *other.median.low;
  }
  return ratio;
}

TimeTable::TimeTable(std::vector<SeriesRow> const& rows, TimeToTarget SeriesRow::*target) : target_(target) {
  for (SeriesRow const& row : rows) {
    TimeToTarget const& time = row.*target;
    if (!row.failures.empty() || !typical(time)) continue;
    auto const known = std::find_if(fastest_.begin(), fastest_.end(),
                                    [&](Fastest const& f) { return f.document == row.document; });
    if (known == fastest_.end()) {
      fastest_.push_back({row.document, time, diverges(row)});
    } else if (known->diverges != diverges(row) ? known->diverges : *typical(time) < *typical(known->time)) {
      *known = {row.document, time, diverges(row)};
    }
  }
}

TimeTable::Entry TimeTable::entry(SeriesRow const& row) const {
  TimeToTarget const& time = row.*target_;
  auto const fastest = std::find_if(fastest_.begin(), fastest_.end(),
                                    [&](Fastest const& f) { return f.document == row.document; });
  if (fastest == fastest_.end()) return {"never"};
  auto const ratio = time_ratio(time, fastest->time);
  if (!ratio) return {"never"};
  std::string const plain = fmt::format("{:.3g}", ratio->value);
  // A bound says neither who is fastest nor by how much.
  if (time.is_bound) return {"<=" + plain};
  if (fastest->time.is_bound) return {">=" + plain};
  if (*typical(time) == *typical(fastest->time)) return {"1", !diverges(row)};
  if (!ratio->low) return {plain};
  bool const holds_one = *ratio->low <= 1.0 && *ratio->high >= 1.0;
  return {with_interval(ratio->value, *ratio->low, *ratio->high) + (holds_one ? "~" : "")};
}

std::string disturbance(std::vector<SeriesRow> const& rows) {
  double lowest = least_busy;
  std::size_t disturbed = 0;
  std::size_t apart = 0;
  for (SeriesRow const& row : rows) {
    if (row.is_timed_apart) ++apart;
    if (!row.busy || *row.busy >= least_busy) continue;
    ++disturbed;
    lowest = std::min(lowest, *row.busy);
  }
  std::vector<std::string> sentences;
  if (disturbed > 0)
    sentences.push_back(fmt::format(
        "Disturbed timings: {} of {} ladders have a run that its processor worked on for less than {:g}% "
        "of the time (at worst {:.0f}%): the machine had other work, or swapped.",
        disturbed, rows.size(), 100.0 * least_busy, 100.0 * lowest));
  if (apart > 0)
    sentences.push_back(fmt::format(
        "Times left out: {} of {} ladders belong to studies whose runs were timed on several machines, and times of two "
        "machines are not compared.",
        apart, rows.size()));
  return fmt::format("{}", fmt::join(sentences, " "));
}

}  // namespace sphverify
