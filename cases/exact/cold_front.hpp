// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace sphverify::exact {

/// Self-similar heat wave from a wall at T = 1 into a medium that is nearly cold, and so conducts nearly
/// nothing.
///
///   dT/dt = d/dx (K dT/dx),   K(T) = K0 T^n,   rho = 1,   T(0, t) = 1,   T(x, 0) = cold,   n >= 0
///   T(x, t) = f(xi),   xi = x/sqrt(K0 t),   (f^n f')' + xi f'/2 = 0,   f(0) = 1,   f(infinity) = cold
///
/// Ahead of the front the wave has a toe as thin as cold^n, below any place that a number can name. So the
/// excess w = f - cold is the coordinate, by its logarithm y = ln w. With the flux q = -f^n f' and p = q/w,
///
///   dp/dy = xi/2 - p,   dxi/dy = -(cold + w)^n / p,
///
/// which is smooth everywhere: dq/dw = xi/2 is the equation above. Integrated upwards from w = 1e-20 cold,
/// p forgets its start within a few units of y, so that the place xi of that start is all there is to find:
/// the one from which the wall's w = 1 - cold is reached at xi = 0. It is found by shooting (GSL,
/// Prince-Dormand 8(9), tolerance 1e-14), then tabulated every 0.01 in y and interpolated by the quintics
/// that have the values and the first two derivatives there.
///
/// With n = 0 this is the erfc of a half space, which it reproduces to 1e-12; as cold falls to 0 it becomes
/// the Marshak wave (cases/exact/marshak.hpp; sources there). For two points see accuracy().
///
/// Specific heat 1; x in m, t >= 0 in s. At t = 0 it is `cold` in x > 0 and 1 at the wall, where the gradient
/// is infinite.
class ColdFront {
 public:
  /// Expects 0 < cold < 1 and cold^n above 1e-200, below which fluxes in the toe would not be numbers.
  ColdFront(double exponent, double cold, double conductivity);

  double temperature(double x, double t) const;
  double gradient(double x, double t) const;
  double conductivity(double temperature) const;

  /// Where the temperature is in the middle between wall and medium.
  double front(double t) const;

  /// Where the excess is as large as `cold`: the front of a medium that were quite cold ends there.
  double foot(double t) const;

  /// In which the excess falls by e there: with cold^n it goes to nothing.
  double foot_width(double t) const;

  /// Heat that has come through the wall, per area: the integral of T - cold.
  double heat(double t) const;

  /// Absolute accuracy of the temperature. Where dT/dx is large, in the front if n > 1, it is the exact
  /// temperature of a point displaced by at most this fraction of its distance from the wall.
  double accuracy() const;

 private:
  struct Node {
    double place, steepness;  // xi, p
  };
  struct Jet {
    double value, first, second;  // with its derivatives by (y - lowest_)/step_
  };
  Jet place_jet(std::size_t k) const;
  Jet steepness_jet(std::size_t k) const;
  static double between(double s, Jet const& low, Jet const& high);

  double place_of(double excess) const;  // xi
  double rank_of(double place) const;    // (y - lowest_)/step_ there; negative beyond the toe
  double excess(double rank) const;      // w

  double exponent_;
  double cold_;
  double conductivity_;
  double lowest_, step_;  // y of the first node, and between nodes
  std::vector<Node> nodes_;
};

}  // namespace sphverify::exact
