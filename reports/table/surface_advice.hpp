// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "reports/error_surface.hpp"

namespace sphverify {

/// Which h/dx to take at a resolution.
enum class SurfaceAdvice {
  law,       ///< the law's: the place of least error is that, or next to it
  measured,  ///< that of least error: the law's gains less over it, by the law, than the law is off
  untried,   ///< likewise: what the law names lies beyond all that gave an error at this resolution
  apart,     ///< the two are far from each other and the law is good enough to say so
};

/// `measured` where there is no law.
SurfaceAdvice advice_at(ErrorSurface const& surface, BestRatio const& best);

/// As the page is told: "law", "measured", "untried", "apart".
char const* word_of(SurfaceAdvice advice);

}  // namespace sphverify
