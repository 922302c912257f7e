// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "reports/results.hpp"

namespace sphverify {

/// How remarks of a second law begin that say what was not watched; the page reads them too.
inline constexpr char const* wall_brings_heat = "a wall brings heat";
inline constexpr char const* no_entropy = "entropy";

/// Whether a run's record can say that temperatures left their bounds: where a wall brings heat there are
/// none, and where a source gives heat or time ran out nothing was watched. The remark tells.
inline bool watched_bounds(SecondLaw const& law) {
  return law.remark.empty() || law.remark.starts_with(no_entropy);
}

/// The same of heat that went from cold to hot, which needs no bounds.
inline bool watched_cold_to_hot(SecondLaw const& law) {
  return watched_bounds(law) || law.remark.starts_with(wall_brings_heat);
}

}  // namespace sphverify
