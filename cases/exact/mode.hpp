// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace sphverify::exact {

/// One Fourier mode of a slab of unit length: `number` half waves between the walls.
struct Mode {
  int number = 1;
  double amplitude = 0.0;  ///< temperature at t = 0

  double wavenumber() const;                                       ///< n pi
  double decay(double conductivity_over_density, double t) const;  ///< exp(-(n pi)^2 kappa t)
};

/// Throws BadValue unless every number is 1 or more and every amplitude finite.
std::vector<Mode> require_modes(std::vector<Mode> modes);

/// Rounding that a sum of modes carries: that of each amplitude and of its phase n pi x.
double rounding(std::vector<Mode> const& modes);

}  // namespace sphverify::exact
