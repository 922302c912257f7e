// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/support/problem.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// One run of a study (or one search of an envelope), as its progress sees it.
struct RunProgress {
  enum class State { waiting, running, paused, finished, finished_before };
  std::size_t kind = 0;  ///< such as the case: times of runs of one kind go as their work
  double work = 1.0;     ///< in any unit
  State state = State::waiting;
  double seconds = 0.0;  ///< that a finished run took, or a running or paused one has taken so far
};

/// About what a run does: pairs of neighbours times steps, whose length falls as the spacing does. Meant for
/// ratios between runs, not for times.
/// @param support of the kernel at this resolution [dx]
double estimated_work(AnyProblem const& problem, LayoutChoice const& layout, int resolution, double support);

/// About how long the rest of a study takes [s]. A run that is not finished is expected to take the mean of
/// the finished ones of its kind and work; else the mean of those of its kind whose work is nearest, times
/// the ratio of the two; else its work times the time that all finished runs took for a unit of theirs. Empty
/// until a run has finished.
/// @param at_a_time how many runs go on at once
std::optional<double> seconds_left(std::vector<RunProgress> const& runs, int at_a_time);

/// "35 s", "12 min", "3.4 h"
std::string duration_text(double seconds);

}  // namespace sphverify
