#pragma once

#include "formulations/pair_geometry.hpp"
#include "harness/integrate/coloured_jacobian.hpp"

namespace sphverify {

/// Which particles' temperatures a conduction rate depends on: its neighbours, and near a wall whatever is
/// interpolated to its foot point; for a two-pass scheme once more through the flux.
template <int Dim>
DependencyPattern dependencies(PairGeometry<Dim> const& geometry, bool two_pass);

}  // namespace sphverify
