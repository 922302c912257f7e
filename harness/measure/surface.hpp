// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "reports/results.hpp"

namespace sphverify {

/// Groups runs that differ only in resolution, h/dx and the seed of a layout, at smoothing exponent 0, and
/// explains the error of each field over those that have at least three resolutions and three h/dx (region
/// `all`; l1 where the solution jumps, l2 elsewhere). A cell of which any replicate failed has no error.
std::vector<Surface> build_surfaces(std::vector<RunRecord> const& runs);

/// Fits the cells of a surface and answers from the fit: the best h/dx of each resolution, the cheapest path
/// in pair interactions and in seconds, and what rules for the neighbour number cost beside it.
///
/// Several laws are fitted (`SurfaceModel`); that of the least information criterion is taken, and refused
/// where it misses the errors by more than half (root mean square of logarithms); so is a law of cost.
/// Intervals: 95%, by a bootstrap of the residuals with a fixed seed: those of a resolution have a part in
/// common (its particles), so have those of an h/dx (what the law does not know of the kernel), and the rest
/// is each cell's own; the three are drawn apart. Laws whose criterion is within 4 of the least compete again
/// in every draw.
/// @param surface its cells in; all else out
void explain_surface(ErrorSurface& surface);

/// The rules of the answers, as `describe` prints them.
extern std::string_view const surface_rules;

}  // namespace sphverify
