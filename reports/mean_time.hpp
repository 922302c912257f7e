// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "reports/results.hpp"

namespace sphverify {

/// Run times of several replicates as one  [s].
struct MeanTime {
  Number seconds;
  MedianSeconds median;
};

/// Mean over all runs; a number is empty for none, or if one of the runs lacks it. If every run's interval
/// holds its median, the means of the ends hold the mean of the medians.
/// @param costs null for a run that was not timed
inline MeanTime mean_time(std::vector<Cost const*> const& costs) {
  auto const mean = [&](auto const& time_of) -> Number {
    double sum = 0.0;
    for (Cost const* cost : costs) {
      Number const time = cost != nullptr ? time_of(*cost) : Number();
      if (!time) return std::nullopt;
      sum += *time;
    }
    return costs.empty() ? Number() : Number(sum / static_cast<double>(costs.size()));
  };
  return {
      mean([](Cost const& c) { return Number(c.seconds); }),
      {mean([](Cost const& c) { return c.median.median; }), mean([](Cost const& c) { return c.median.low; }),
       mean([](Cost const& c) { return c.median.high; })}};
}

}  // namespace sphverify
