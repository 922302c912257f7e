// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/walls/walls.hpp"

namespace sphverify {

/// Velocity of a wall that prescribes none and that no particle reaches: what the closure's value tends to as
/// the last particle, the nearest one, leaves the wall. A sum of kernels vanishes; a quotient of them keeps
/// that particle's value.  [m/s]
/// Expects at least one particle, with density, pressure and velocity.
template <int Dim>
Vector<Dim> velocity_out_of_reach(Wall<Dim> const& wall, Particles<Dim> const& particles, Closure closure,
                                  double time);

}  // namespace sphverify
