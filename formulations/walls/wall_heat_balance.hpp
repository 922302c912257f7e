// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/walls/walls.hpp"

namespace sphverify {

/// The temperature T_B of a wall that loses heat by it, seen from a temperature inside the fluid at a
/// distance d: as much must reach the wall by Fourier's law as it loses,
///
///   K (T - T_B)/d = loss(T_B).
///
/// The loss rises with T_B and is zero at the environment's temperature, so that there is one solution and it
/// lies between that and T. It is found to rounding (TOMS 748).  [K]
/// @param conductance K/d [W/(m^2 K)]; where it is zero the wall gets nothing to lose, and is as its environment
/// NaN where T or the loss at T is not finite.
double balanced_wall_temperature(HeatLoss const& loss, double temperature, double conductance);

}  // namespace sphverify
