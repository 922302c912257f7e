// SPDX-License-Identifier: 0BSD
// A form of two passes: the first writes a matrix for every particle, the second reads it.
#pragma once

#include <Eigen/LU>

#include "formulations/scheme.hpp"

/// Pressure gradient that is exact where pressure is linear, on any particles (Randles & Libersky 1996, Comput. Methods Appl.
/// Mech. Eng. 139, 375; Bonet & Lok 1999, ibid. 180, 97), with a wall that counts as one more neighbour at its foot point.
///
///   L_i^-1 = sum_j m_j/rho_j (r_j - r_i) (x) grad_i W_ij + (r_B - r_i) (x) S_i
///   a_i    = -1/rho_i L_i [ sum_j m_j/rho_j (P_j - P_i) grad_i W_ij + (P_B - P_i) S_i ]   [m/s^2]
struct LinearGradient {
  struct Matrix {
    static constexpr sphverify::PassInfo info{.name = "matrix",
                                              .writes = sphverify::Field::pass_tensor,
                                              .reads = {sphverify::Field::density},
                                              .kernel = {sphverify::KernelWeight::gradient}};

    static auto pair(auto const&, auto const& j, auto const& W) {
      return -j.m() / j.rho() * outer(W.separation(), W.gradient());  // W.separation() is r_i - r_j
    }
    static auto wall(auto const&, auto const& B) { return (B.d() / B.A() * sphverify::outer(B.S(), B.S())).eval(); }
    static auto finish(auto const&, auto const& sum) { return sum.inverse().eval(); }
  };

  static constexpr sphverify::SchemeInfo info{
      .id = "momentum/linear-gradient",
      .title = "Pressure gradient that is exact where pressure is linear",
      .source = "Randles & Libersky 1996; Bonet & Lok 1999",
      .equation = "L_i^-1 = sum_j m_j/rho_j (r_j - r_i) (x) grad_i W_ij + (r_B - r_i) (x) S_i\n"
                  "a_i = -1/rho_i L_i [ sum_j m_j/rho_j (P_j - P_i) grad_i W_ij + (P_B - P_i) S_i ]",
      .remarks = "An example of a scheme from outside. Conserves nothing to round-off.",
      .rate = sphverify::Rate::acceleration,
      .reads = {sphverify::Field::density, sphverify::Field::pressure},
      .kernel = {sphverify::KernelWeight::gradient},
      .boundary = {sphverify::BoundaryValue::pressure},
      .first_passes = {Matrix::info},
      .work_partner = "work/internal-energy",
      .claims = {.lattice_factors = 0, .steady_on_any_particles = true}};
  using passes = sphverify::PassList<Matrix>;

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return (-j.m() * (j.P() - i.P()) / (i.rho() * j.rho()) * (i.pass_tensor() * W.gradient())).eval();
  }
  static auto wall(auto const& i, auto const& B) {
    return (-(B.P() - i.P()) / i.rho() * (i.pass_tensor() * B.S())).eval();
  }
};
