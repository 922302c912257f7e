// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <string>
#include <vector>

#include "reports/table/summary.hpp"

namespace sphverify {

/// How good a formulation is over scenes: the fewer fail the better, then the fewer diverge, then the smaller
/// the mean logarithm of the error. What did not run counts as failed.
struct Score {
  int failed = 0;
  int diverging = 0;
  double log_error = 0.0;
  std::partial_ordering operator<=>(Score const&) const = default;
};

Outcome outcome_of(SeriesRow const* ladder);

/// Error of a ladder for ranking: relative where there is a scale, and never below what rounding explains.
Number error_of(SeriesRow const& ladder);

/// @param ladders one per scene, null where it did not run
Score score_of(std::vector<SeriesRow const*> const& ladders);

/// A setting and the ladders that it stands for.
struct BestSetting {
  std::vector<std::string> choices;       ///< names of what was varied on a case
  std::vector<SeriesRow const*> ladders;  ///< per scene, null where that setting did not run
  std::size_t tried = 0;                  ///< settings that ran on all of the formulation's scenes
};

/// The best of the settings that one formulation ran with. What has one value only on a case, such as a
/// viscosity that the case chooses, is no choice there and belongs to every setting.
/// @param ladders of one formulation
/// @param scene_of index of each ladder's scene
BestSetting best_setting(std::vector<SeriesRow const*> const& ladders,
                         std::vector<std::size_t> const& scene_of, std::size_t scenes);

}  // namespace sphverify
