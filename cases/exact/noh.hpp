// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/gas_state.hpp"

namespace sphverify::exact {

/// Noh's problem: cold gas that streams with unit speed towards a plane, an axis or a point is brought to
/// rest by a shock that runs outwards. W. F. Noh, J. Comput. Phys. 72 (1987) 78.
///
///   t = 0:   rho = 1,   v_r = -1,   P = 0;   P = (gamma - 1) rho e;   d the dimension
///
/// Ahead of the shock, P = 0 and each particle keeps its velocity, so that what was at r + t is at r, denser
/// by the ratio of the surfaces: rho = (1 + t/r)^(d-1). Behind, the gas is at rest with its kinetic energy
/// turned into heat, e = 1/2. The shock's speed is D = (gamma-1)/2 and there t/r = 1/D everywhere: mass flows
/// in at (1 + 1/D)^(d-1) (1 + D) and fills the volume left behind at D, so rho = (1 + 1/D)^d, which is
/// ((gamma+1)/(gamma-1))^d.
///
/// Lengths in m, times in s and densities in kg/m3; velocities in m/s. Any d >= 1 will do: 1 is planar, 2
/// cylindrical, 3 spherical.
class Noh {
 public:
  Noh(int dimension, double gamma);

  /// r, t >= 0; the velocity is radial. Where r = t = 0 it is the initial state.
  GasState at(double r, double t) const;

  double shock_speed() const;

  /// Relative accuracy of density, velocity and pressure away from the shock.
  double accuracy() const;

 private:
  int dimension_;
  double gamma_;
};

}  // namespace sphverify::exact
