// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cases/exact/mode.hpp"

namespace sphverify::exact {

/// Heat conduction in the slab 0 <= x <= 1 m between insulated walls.
///
///   rho dT/dt = K d2T/dx2,   dT/dx = 0 at x = 0 and x = 1
///   T(x, t) = mean + sum_n a_n cos(n pi x) exp(-(n pi)^2 K t / rho)
///
/// Separation of variables with a finite set of modes, hence exact (Carslaw & Jaeger 1959, chapter III). The
/// mean is conserved. Specific heat 1; T in units of energy per mass, t >= 0 in s, any x in m: outside the
/// slab the formula continues smoothly. Accurate to rounding, see accuracy().
class SlabInsulated {
 public:
  SlabInsulated(double mean, std::vector<Mode> modes, double conductivity, double density);

  double temperature(double x, double t) const;
  double gradient(double x, double t) const;  ///< dT/dx

  /// Absolute accuracy of the temperature.
  double accuracy() const;

 private:
  double mean_;
  std::vector<Mode> modes_;
  double diffusivity_;
};

}  // namespace sphverify::exact
