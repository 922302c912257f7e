// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "reports/results.hpp"

namespace sphverify {

/// One level of a refinement ladder: a spacing and the errors of its replicates (one per seed, or a single
/// one).
struct LadderLevel {
  double spacing;              ///< [any unit]
  std::vector<double> errors;  ///< absolute; empty if no run of this level ended well
  double round_off;            ///< error that rounding alone explains, in the same unit
  bool out_of_time =
      false;      ///< it has none since its runs did not get the time, whatever they were about to do
  Number mean{};  ///< of computed - exact, with its sign; empty where there is no sign
};

/// What is known of a ladder beside its errors.
struct LadderContext {
  Number allowed{};           ///< highest order that the solution allows in this norm
  Number time_error_share{};  ///< largest part of these errors that the integration in time may have
};

/// Observed order of convergence with its 95% interval, floor, and the verdict on the ladder.
///
/// Order and interval are the median and the central part of what the error laws of error_law.hpp say
/// together, each with its probability. Levels whose error is at round-off say nothing of the order and are
/// left out, and so are those before the signed error passed through zero, if it did so once. The rules of
/// the verdict are in `verdict_rules`, the reasons in docs/decisions/0009.
/// @param levels coarse to fine
ObservedOrder observed_order(std::vector<LadderLevel> const& levels, LadderContext const& context = {});

/// Particles along the first axis at the levels that a law was fitted to. The fitted law's unit is the finest
/// spacing.
struct LadderExtent {
  double coarsest = 0.0, finest = 0.0;
};

/// Of the levels that are fitted: those above round-off, after the signed error passed through zero; 0 and 0
/// where there is none. Resolutions of a ladder go as 1/spacing.
/// @param times_spacing resolution times spacing of any level
LadderExtent extent_of(std::vector<LadderLevel> const& levels, double times_spacing);

/// The remark of a target that the coarsest level has reached.
inline constexpr char const* coarsest_has_it = "the coarsest level has it";

/// Where the fitted law comes down to an error; never, where that lies below the floor.
TargetResolution resolution_for(ObservedOrder const& observed, double error, LadderExtent const& extent);

/// The rules of the verdicts, as `describe` prints them.
extern std::string_view const verdict_rules;

}  // namespace sphverify
