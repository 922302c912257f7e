// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/momentum/reverse_correction.hpp"

namespace sphverify {

/// Pressure gradient with kernel gradients corrected by each other's matrix, "reverse kernel gradient correction" (Zhang, Zhu & Hu
/// 2025, J. Comput. Phys., arXiv 2406.02576).
///
///   a_i = -(1/rho_i) [ sum_j m_j/rho_j (P_i L_j + P_j L_i) grad_i W_ij + P_B (sigma_i . n) n ]   [m/s^2]
///
/// The sum is L_i sum_j V_j (P_j - P_i) grad W, exact for linear P, plus P_i sum_j V_j (L_i + L_j) grad W, which vanishes on
/// particles that are relaxed. Conserves linear momentum to round-off between particles. The wall term is ours: it closes just what
/// the pairs leave open along n, so that a uniform gas feels nothing there on any particles.
struct ReverseCorrectedGradient {
  static constexpr SchemeInfo info{
      .id = "momentum/rkgc",
      .title = "Conservative pressure gradient with reverse correction of the kernel's gradient",
      .source = "Zhang, Zhu & Hu 2025 (arXiv 2406.02576); matrix as Bonet & Lok 1999; wall term ours, by the budget of Campbell 1989, Eq. 17",
      .equation = "L_i^-1 = (1/Gamma_i) [ sum_j m_j/rho_j (r_j-r_i) (x) grad_i W_ij + d_i n (x) S_i ]\n"
                  "sigma_i = -sum_j m_j/rho_j (L_i + L_j) grad_i W_ij\n"
                  "a_i = -(1/rho_i) [ sum_j m_j/rho_j (P_i L_j + P_j L_i) grad_i W_ij + P_B (sigma_i.n) n ]",
      .remarks = "Exact for linear pressure on lattices; on disorder a uniform pressure pushes, along walls at walls. Between two walls "
                 "that face each other within one support both close the same surface. On disorder the wall's part begins and ends at once "
                 "where a particle comes within reach. In corners the matrix is not near 1.",
      .rate = Rate::acceleration,
      .reads = {Field::density, Field::pressure},
      .kernel = {KernelWeight::gradient},
      .boundary = {BoundaryValue::pressure},
      .conserves = {Invariant::momentum},
      .first_passes = {ReverseCorrection::info, MissingSurface::info},
      .work_partner = "work/rkgc",
      .claims = {.lattice_factors = 0, .energy_with_partner = true},
      .supports_seen = 2,
      .wall_pressure_share = 1.0,
      .needs_partners = true};
  using passes = PassList<ReverseCorrection, MissingSurface>;

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return (-j.m() / i.rho() / j.rho() * ((i.P() * j.pass_tensor() + j.P() * i.pass_tensor()) * W.gradient())).eval();
  }
  static auto wall(auto const& i, auto const& B) {
    return (-(B.P() / i.rho()) * i.pass_vector().dot(B.n()) * B.n()).eval();
  }
};

}  // namespace sphverify
