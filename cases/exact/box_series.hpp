// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "formulations/basics/vector.hpp"

namespace sphverify::exact {

/// One product of sines or cosines in the unit box: half waves along each axis.
template <int Dim>
struct BoxMode {
  std::array<int, Dim> numbers{};
  double amplitude = 0.0;  ///< temperature at t = 0
};

/// What the sides of the box hold; x = 0 and x = 1 keep their temperatures in both.
enum class BoxSides {
  dirichlet,  ///< the others keep the temperatures of the straight line between those two
  insulated   ///< the others pass no heat
};

/// Heat conduction in the box [0, 1]^Dim m.
///
///   rho dT/dt = K lap T,   T = left at x = 0, right at x = 1
///   T(r, t) = left + (right - left) x + sum a f_1(x) f_2(y) [f_3(z)] exp(-(n_1^2 + n_2^2 [+ n_3^2]) pi^2 K
///   t/rho)
///
/// with f_1 = sin(n_1 pi x), and along the other axes f_k = sin(n_k pi r_k) between sides that keep
/// left + (right - left) x, or cos(n_k pi r_k) between insulated ones, where n_k = 0 is a mode uniform along
/// that axis. Each product vanishes, or has no slope, on the sides at all times, so that the state at t = 0
/// agrees with what every side, edge and corner holds.
///
/// Separation of variables with a finite set of modes, hence exact (Carslaw & Jaeger, Conduction of Heat in
/// Solids, 2nd ed. 1959, chapters V and VI). Specific heat 1; T in units of energy per mass, t >= 0 in s, any
/// r in m: outside the box the formula continues smoothly. Accurate to rounding, see accuracy().
template <int Dim>
class BoxSeries {
  static_assert(Dim == 2 || Dim == 3);

 public:
  /// Throws BadValue for a number below 1 (below 0 along insulated axes), for what is not
  /// finite, and unless conductivity and density are positive.
  BoxSeries(double left, double right, std::vector<BoxMode<Dim>> modes, BoxSides sides, double conductivity,
            double density);

  double temperature(Vector<Dim> const& r, double t) const;
  Vector<Dim> gradient(Vector<Dim> const& r, double t) const;

  /// Absolute accuracy of the temperature.
  double accuracy() const;

 private:
  /// A mode's factor along an axis, and that factor's slope.
  double factor(BoxMode<Dim> const& mode, int axis, double coordinate) const;
  double slope(BoxMode<Dim> const& mode, int axis, double coordinate) const;
  double decay(BoxMode<Dim> const& mode, double t) const;

  double left_;
  double right_;
  std::vector<BoxMode<Dim>> modes_;
  BoxSides sides_;
  double diffusivity_;
};

}  // namespace sphverify::exact
