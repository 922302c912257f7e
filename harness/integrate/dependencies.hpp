// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/pair_geometry.hpp"
#include "harness/integrate/coloured_jacobian.hpp"

namespace sphverify {

/// Which particles' temperatures a conduction rate depends on: its neighbours, and near a wall whatever is
/// interpolated to its foot point; with every pass before that of the rate once more.
/// @param passes how many the scheme has
template <int Dim>
DependencyPattern dependencies(PairGeometry<Dim> const& geometry, int passes);

}  // namespace sphverify
