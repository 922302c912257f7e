// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/surface_advice.hpp"

#include <algorithm>
#include <cmath>

namespace sphverify {

SurfaceAdvice advice_at(ErrorSurface const& surface, BestRatio const& best) {
  if (!best.ratio.value) return SurfaceAdvice::measured;
  if (!best.grid_ratio) return SurfaceAdvice::law;
  double const by_law = *best.ratio.value;
  double const measured = *best.grid_ratio;
  double lowest = measured, highest = measured;  // of what gave an error here
  bool is_next = true;                           // nothing that gave an error lies between the two
  std::optional<double> fitted;                  // the law's error where least was measured
  for (SurfaceCell const& cell : surface.cells) {
    if (cell.resolution != best.resolution || !cell.error) continue;
    double const ratio = cell.smoothing_ratio;
    lowest = std::min(lowest, ratio);
    highest = std::max(highest, ratio);
    if (ratio == measured) fitted = cell.fitted;
    is_next = is_next &&
              (ratio == measured || ratio < std::min(by_law, measured) || ratio > std::max(by_law, measured));
  }
  constexpr double rounding = 1e-9;
  if (by_law < lowest * (1.0 - rounding) || by_law > highest * (1.0 + rounding))
    return SurfaceAdvice::untried;
  if (is_next) return SurfaceAdvice::law;
  if (fitted && best.error && surface.misfit && *fitted <= *best.error * std::exp(*surface.misfit))
    return SurfaceAdvice::measured;
  bool const is_held = best.ratio.lower && best.ratio.upper && *best.ratio.lower <= measured && measured <= *best.ratio.upper;
  return is_held ? SurfaceAdvice::law : SurfaceAdvice::apart;
}

char const* word_of(SurfaceAdvice advice) {
  switch (advice) {
    case SurfaceAdvice::law:
      return "law";
    case SurfaceAdvice::measured:
      return "measured";
    case SurfaceAdvice::untried:
      return "untried";
    case SurfaceAdvice::apart:
      break;
  }
  return "apart";
}

}  // namespace sphverify
