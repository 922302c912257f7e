#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "reports/results.hpp"

namespace sphverify {

/// How often a run is timed.
struct RepeatRule {
  int most = 1;
  int least = 1;        ///< repeats before their spread is looked at
  double spread = 0.0;  ///< enough once the interval of the median is narrower than this part of it; 0: never
  double seconds = 0.0;  ///< no further repeat once all took so long together; 0: no limit
};

/// Rank from the smallest, and from the largest, of the repeats that bound the 95% interval of the median of
/// n of them; 0 where n repeats give none (n < 6). Whatever the times are drawn from, each is below the
/// median as often as not, so that the number of those below is binomial (David & Nagaraja 2003, Order
/// Statistics, 7.1).
std::size_t median_rank(std::size_t n);

/// Median of repeated times with its 95% interval. Empty for none.
MedianSeconds median_of(std::vector<double> seconds);

/// Repeats a timed run until the rule has enough, at least once, and gives the cost of the fastest repeat
/// with the median of all. The caller has carried out the same run before, which warms caches, memory and
/// clock up and does not count.
/// @param once one repeat; empty if it broke, which ends the repeats
/// @param out_of_time whether no further repeat may start
/// @return empty if the first repeat broke
std::optional<Cost> time_repeats(RepeatRule const& rule, std::function<std::optional<Cost>()> const& once,
                                 std::function<bool()> const& out_of_time);

/// How many runs to time together so that they last at least a millisecond, a thousand times what reading a
/// clock may be wrong by: the first power of two that does.
/// @param seconds_of wall time of so many runs, carried out [s]
int batch_for(std::function<double(int)> const& seconds_of);

}  // namespace sphverify
