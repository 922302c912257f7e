// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cases/exact/mode.hpp"

namespace sphverify::exact {

/// Heat conduction in the slab 0 <= x <= 1 m whose walls are held at fixed temperatures.
///
///   rho dT/dt = K d2T/dx2,   T(0, t) = left,   T(1, t) = right
///   T(x, t) = left + (right - left) x + sum_n a_n sin(n pi x) exp(-(n pi)^2 K t / rho)
///
/// Separation of variables with a finite set of modes, hence exact (Carslaw & Jaeger, Conduction of Heat in
/// Solids, 2nd ed. 1959, chapter III). Specific heat 1; T in units of energy per mass, t >= 0 in s, any x in
/// m: outside the slab the formula continues smoothly. Accurate to rounding, see accuracy().
class SlabDirichlet {
 public:
  SlabDirichlet(double left, double right, std::vector<Mode> modes, double conductivity, double density);

  double temperature(double x, double t) const;
  double gradient(double x, double t) const;  ///< dT/dx

  /// Absolute accuracy of the temperature.
  double accuracy() const;

 private:
  double left_;
  double right_;
  std::vector<Mode> modes_;
  double diffusivity_;
};

}  // namespace sphverify::exact
