// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
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

/// Median, with its 95% interval, of the quotients of two runs' times in the rounds that both took part in.
/// What changes from round to round (another clock, other work on the machine) is in both times of a
/// quotient. Empty unless the runs took turns; no interval for fewer than six rounds.
MedianSeconds median_ratio(Cost const& time, Cost const& other);

/// The timed repeats of one run, one at a time. The caller has carried out the same run before, which warms
/// caches, memory and clock up and does not count.
class Repeats {
 public:
  /// @param once one repeat; empty if it broke, which ends the repeats
  /// @param out_of_time whether no further repeat may start; the first one always may
  Repeats(RepeatRule const& rule, std::function<std::optional<Cost>()> once,
          std::function<bool()> out_of_time);

  /// Carries out one that does not count: where the run before was another process's.
  void warm_up();

  /// Carries out one more.
  void repeat();

  /// No further repeat may follow: there are as many as the rule allows, they took as long, or one broke.
  bool is_over() const;

  /// The interval of the median is as narrow as the rule asks for.
  bool is_narrow() const;

  /// Cost of the fastest repeat with the median of all; empty if the first broke.
  std::optional<Cost> cost() const;

  /// Wall time of all repeats, with all runs of a batch [s].
  double spent() const { return spent_; }

  /// Wall times of the repeats, in their order [s].
  std::vector<double> const& seconds() const { return seconds_; }

 private:
  RepeatRule rule_;
  std::function<std::optional<Cost>()> once_;
  std::function<bool()> out_of_time_;
  std::optional<Cost> fastest_;
  std::vector<double> seconds_;
  double spent_ = 0.0;
  Number busy_ = 0.0;  ///< processor time
  bool broken_ = false;
};

/// Repeats a run until its rule has enough, at least once.
std::optional<Cost> time_repeats(RepeatRule const& rule, std::function<std::optional<Cost>()> const& once,
                                 std::function<bool()> const& out_of_time);

/// Repeats several runs in rounds, each once a round, every other round in the opposite order, so that a
/// machine that slows down or speeds up does it to all of them. A run drops out when it is over; the rest end
/// together, once the intervals of all of them are narrow enough.
/// @param occasion names these rounds in the costs
/// @return a cost for each, with the times of its rounds
std::vector<std::optional<Cost>> take_turns(std::vector<Repeats>& runs, std::string const& occasion);

/// How many runs to time together so that they last at least a millisecond, a thousand times what reading a
/// clock may be wrong by: the first power of two that does.
/// @param seconds_of wall time of so many runs, carried out [s]
int batch_for(std::function<double(int)> const& seconds_of);

}  // namespace sphverify
