// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/support/problem.hpp"
#include "formulations/particles/particles.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// Measures a shock that runs along the first axis: its place, where the pressure crosses the middle of the
/// jump (linear between neighbouring particles, the crossing nearest to the exact place), and the means over
/// the middle three fifths of the plateau behind it, weighted by mass over density. Reads density, velocity,
/// pressure.
template <int Dim>
ShockRecord measure_shock(Particles<Dim> const& particles, ShockFront const& front);

}  // namespace sphverify
