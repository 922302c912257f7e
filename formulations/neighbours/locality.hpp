// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "formulations/particles/domain.hpp"
#include "formulations/particles/particles.hpp"

namespace sphverify {

/// The order in which particles lie along a space-filling curve (Morton's) through cells of a given size, so
/// that who is near in space is mostly near in memory: entry n is the particle to be put at place n.
/// Particles of one cell keep their order. Cells are along the axes of the box, which the particles may have
/// left.
/// @param cell edge of the cells [m], positive; the kernel's support serves
template <int Dim>
std::vector<std::uint32_t> locality_order(VectorField<Dim> const& positions, Domain<Dim> const& domain,
                                          double cell);

}  // namespace sphverify
