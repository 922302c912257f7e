// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "formulations/scheme.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// Work of compression on internal energy, the partner of momentum/sqrt-p. The report has none: this one is ours.
///
///   de_i/dt = -(sqrt(P_i)/rho_i) [ sum_j m_j (sqrt(P_j)/rho_j) (v_j - v_i) . grad_i W_ij
///                                  + sqrt(P_B) (v_B - v_i) . S_i ]                              [W/kg]
///
/// Derivation: with s = sqrt(P)/rho, Eq. 20 changes kinetic energy by
///   sum_i m_i v_i.a_i = -2 sum_ij m_i m_j s_i s_j v_i.grad_i W_ij = -sum_ij m_i m_j s_i s_j (v_i - v_j).grad_i W_ij,
/// so the pair must give +m_i m_j s_i s_j (v_i - v_j).grad_i W_ij per directed pair to internal energy, half of the
/// undirected pair's to each side. The wall term follows from the same kernel estimate of -(P/rho) div v
/// = -s [div(sqrt(P) v) - v.grad sqrt(P)] with its surface integral kept; with Eq. 20's it makes the wall's power
/// -sum_i m_i s_i sqrt(P_B) (v_i + v_B).S_i, which is -P_B v_B.n per area as in Eq. 40.
struct SquareRootOfPressureWork {
  static constexpr SchemeInfo info{
      .id = "work/sqrt-p",
      .title = "Work of compression on internal energy, partner of momentum/sqrt-p",
      .source = "ours: the energy-conserving partner of Campbell 1989, Eq. 20",
      .equation = "de_i/dt = -(sqrt(P_i)/rho_i) [ sum_j m_j (sqrt(P_j)/rho_j) (v_j - v_i).grad_i W_ij"
                  " + sqrt(P_B) (v_B - v_i).S_i ]",
      .remarks = "Conserves total energy together with momentum/sqrt-p. Undefined for P < 0. Galilean invariant.",
      .rate = Rate::internal_work,
      .reads = {Field::density, Field::pressure, Field::velocity},
      .kernel = {KernelWeight::gradient},
      .boundary = {BoundaryValue::pressure, BoundaryValue::velocity},
      .non_negative = {Field::pressure},
      .claims = {.steady_on_any_particles = true}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    using std::sqrt;
    return -(sqrt(i.P()) / i.rho()) * j.m() * (sqrt(j.P()) / j.rho()) * (j.v() - i.v()).dot(W.gradient());
  }
  static auto wall(auto const& i, auto const& B) {
    using std::sqrt;
    return -(sqrt(i.P()) / i.rho()) * sqrt(B.P()) * (B.v() - i.v()).dot(B.S());
  }
};

}  // namespace sphverify
