// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/table/series_row.hpp"

namespace sphverify {

/// A quotient of two times. The ends are those of the two intervals, divided crosswise: where each interval
/// holds its median, they hold the quotient of the medians. Empty ends where one of the two has none.
struct TimeRatio {
  double value;
  Number low, high;
};

/// Empty where a time is, or where what divides is zero. Medians where both have them, else the times
/// themselves.
std::optional<TimeRatio> time_ratio(TimeToTarget const& time, TimeToTarget const& other);

/// Run times to an error as ratios to the fastest. Times that were taken on different occasions do not
/// compare: every results document has a fastest of its own.
class TimeTable {
 public:
  struct Entry {
    std::string text;
    bool is_fastest = false;
  };

  TimeTable(std::vector<SeriesRow> const& rows, TimeToTarget SeriesRow::*target);

  /// Whether any of the rows ever got there.
  bool is_empty() const { return fastest_.empty(); }

  /// "2.4 (1.9-3.1)" or "1.09±0.05", with a "~" if 1 lies inside. What the coarsest level reached already is
  /// at most that ("<="), and the others are at least what they are of such a fastest (">="). What diverges
  /// gets there by chance: it is never the fastest, and its ratio is to the fastest of the others if any.
  Entry entry(SeriesRow const& row) const;

 private:
  struct Fastest {
    std::string document;
    TimeToTarget time;
    bool diverges = false;
  };

  TimeToTarget SeriesRow::*target_;
  std::vector<Fastest> fastest_;  ///< of every document in which one got there
};

/// What a reader of run times should know: that the processor did not work all the time on runs that were timed, or
/// that they were timed on several machines. A sentence each; empty where there is nothing to say.
std::string disturbance(std::vector<SeriesRow> const& rows);

}  // namespace sphverify
