// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "cases/exact/gas_state.hpp"

namespace sphverify::exact {

/// Two uniform gases that meet at x0 at t = 0 (shock tube), P = (gamma - 1) rho e, without viscosity and heat
/// conduction. The state depends on s = (x - x0)/t alone: on each side a shock or a fan runs into the
/// unperturbed gas, between them the contact separates what came from the left and from the right.
///
/// E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed. (2009), chapter 4;
/// L. D. Landau & E. M. Lifshitz, Fluid Mechanics, sections 99 and 100.
///
/// Derivation. The wave that runs into side K turns the pressure P_K into P and slows the gas, counted
/// towards the other side, by f_K(P):
///
///   f_K(P) = (P - P_K) / Q_K,   Q_K^2 = rho_K ((gamma+1) P + (gamma-1) P_K) / 2      P > P_K, a shock;
///   f_K(P) = 2 c_K/(gamma-1) [(P/P_K)^((gamma-1)/(2 gamma)) - 1]                     P <= P_K, a fan.
///
/// So u = u_L - f_L = u_R + f_R at the contact, where pressure and velocity have one value each, gives
///
///   f_L(P) + f_R(P) + u_R - u_L = 0.
///
/// The sum rises and is concave, so Newton's method climbs from any pressure below the root to it without
/// ever passing it: we look for such a start, and stop where rounding stops the climb.
///
/// An expansion to P = 0 speeds a gas up by no more than its escape speed -f_K(0) = 2 c_K/(gamma-1). Where
/// u_R - u_L is at least the sum of both there is no root and a vacuum opens, from u_L + 2 c_L/(gamma-1) to
/// u_R - 2 c_R/(gamma-1). Next to a side that is a vacuum already, the gas expands up to its own front.
///
/// Pressure 0 is allowed: cold streams collide in two shocks, drift side by side, or part and leave a vacuum.
/// On a vacuum side (density 0) the pressure must be 0, and the velocity means nothing but is handed back.
class Riemann {
 public:
  /// Between the waves, on both sides of the contact.
  struct Star {
    double pressure;
    double velocity;
    double density_left;
    double density_right;
  };

  /// Speeds in ascending order. The head of a wave borders on the unperturbed gas; a shock's head and tail
  /// are equal. Where a vacuum opens, the tails are its fronts and `contact` is the middle of it. If a side
  /// is a vacuum, its head and tail and the contact are all the front of the gas.
  struct Waves {
    double left_head;
    double left_tail;
    double contact;
    double right_tail;
    double right_head;
  };

  /// Throws BadValue too where the pressure at the contact is no vacuum's but less than 1e-280
  /// times the pressures outside. This takes a gamma close to 1, below 1.2, and gases that part fast.
  Riemann(GasState const& left, GasState const& right, double gamma);

  /// speed: (x - x0)/t for t > 0; -infinity and infinity, the limits t -> 0, give the unperturbed states.
  /// On a discontinuity it is the state to the right. In a vacuum that opened in between, density and
  /// pressure are 0 and the velocity is `speed`, which joins the velocities of the fronts linearly.
  GasState at(double speed) const;

  /// None if a vacuum opens in between or one side is a vacuum.
  std::optional<Star> star() const;

  Waves const& waves() const;

  /// Accuracy of density, pressure and velocity for gamma <= 3, as fractions of the largest density, the
  /// largest pressure and the largest |velocity| or |wave speed| of the solution. Discontinuities stand where
  /// they should within this fraction of the latter. (With gamma > 3 a fan's density ends at a vacuum with
  /// infinite slope.)
  double accuracy() const;

 private:
  GasState left_;
  GasState right_;
  double gamma_;
  std::optional<Star> star_;
  Waves waves_;
};

}  // namespace sphverify::exact
