// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace sphverify::exact {

/// The gas at a point of a flow that depends on one coordinate. A vacuum is density 0.
struct GasState {
  double density;   ///< kg/m3
  double velocity;  ///< m/s, along the coordinate
  double pressure;  ///< Pa
};

/// sqrt(gamma P / rho), in m/s; 0 in a vacuum.
inline double sound_speed(GasState const& state, double gamma) {
  return state.density > 0.0 ? std::sqrt(gamma * state.pressure / state.density) : 0.0;
}

}  // namespace sphverify::exact
