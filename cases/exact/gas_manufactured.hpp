// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/basics/vector.hpp"

namespace sphverify::exact {

/// Manufactured flow of a gamma-law gas, with heat conduction if wanted, between two moving walls
/// x = x_L(t) and x = x_R(t); every axis but the first is periodic with period 1.
///
///   x_L = 0.06 (sin(2.7 t + 0.4) - sin 0.4),   x_R = 1 - 0.05 (sin(4.1 t - 0.9) + sin 0.9),   L = x_R - x_L
///   zeta = (x - x_L)/L
///   m(zeta, t) = 1.2 zeta + (0.25/1.9) (sin(1.9 zeta + 0.4) - sin 0.4) + a sin(pi zeta)/pi
///   a = 0.2 sin(1.7 t + 0.3)
///   h = 1 + 0.15 cos(2 pi ((y - Y) + (z - Z)))        (in 1D h = 1, in 2D without z)
///   Y = 0.1 sin(1.3 m + 2.3 t + 0.2),   Z = 0.08 sin(0.9 m - 1.6 t + 2)
///
///   1/rho = h L / m_zeta
///   v     = ( -m_t/m_x, Y_t, Z_t ), the derivatives of m at fixed x and t, of Y and Z at fixed m
///   P     = 2 + 0.5 x + 0.2 sin(0.5 + 2.1 x - 1.9 t + 2 pi y - 2 pi z)
///   e     = T = P/((gamma-1) rho)        K = scale (1 + T/5)
///
/// Mass needs no source, so that particles can keep theirs: m, y - Y and z - Z move with the gas, hence so
/// does h, and rho h = m_x obeys the continuity equation in x because v_x moves m; v_y and v_z depend on x
/// and t alone. As m is 0 at the left wall and constant at the right one, the gas there moves with the walls.
///
/// The walls are at 0 and 1 at t = 0, moving already. At all times 0.87 <= L <= 1.1, 0.65 <= rho <= 2.2 (0.75
/// to 1.9 in 1D), 1.75 <= P <= 2.71, and in 1D 0.08 <= dP/dx <= 0.92. Specific heat 1; lengths in m, times
/// in s.
///
/// The sources, per unit mass, that make this a solution:
///
///   acceleration = Dv/Dt + grad P / rho
///   heating      = De/Dt + (P/rho) div v - div(K grad T)/rho
///
/// Method of manufactured solutions: P. J. Roache, J. Fluids Eng. 124 (2002) 4; the fields are ours. All is
/// closed and exact to rounding, see accuracy().
template <int Dim>
class GasManufactured {
  static_assert(Dim >= 1 && Dim <= 3);

 public:
  /// A conductivity scale of 0 is a gas that conducts no heat.
  GasManufactured(double gamma, double conductivity_scale);

  double density(Vector<Dim> const& r, double t) const;
  Vector<Dim> velocity(Vector<Dim> const& r, double t) const;
  double pressure(Vector<Dim> const& r, double t) const;
  double internal_energy(Vector<Dim> const& r, double t) const;  ///< per unit mass; the temperature too
  double conductivity(double temperature) const;
  Vector<Dim> flux(Vector<Dim> const& r, double t) const;  ///< -K grad T

  double wall_position(int side, double t) const;  ///< side 0: left, 1: right
  double wall_velocity(int side, double t) const;

  Vector<Dim> acceleration_source(Vector<Dim> const& r, double t) const;
  double heating_source(Vector<Dim> const& r, double t) const;

  /// Absolute accuracy of density, velocity, pressure and (gamma-1) times the internal energy for
  /// 0 <= t <= 10; later the phases lose digits as t grows.
  double accuracy() const;

 private:
  double gamma_;
  double scale_;
};

}  // namespace sphverify::exact
