// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "reports/error_surface.hpp"

namespace sphverify {

/// The law's error at a spacing and h/dx. Between the ratios that a law has sampling errors for, and beyond
/// them, their logarithm is linear in that of the ratio.
double surface_error(SurfaceLaw const& law, double spacing, double ratio);

/// How a law's sampling errors by ratio fall with h/dx: the power that comes closest to them, by least
/// squares of the logarithms. 0 for fewer than two ratios.
double sampling_slope(std::vector<SamplingAtRatio> const& sampling);

}  // namespace sphverify
