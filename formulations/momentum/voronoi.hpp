// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/basics/vector.hpp"
#include "formulations/scheme.hpp"

namespace sphverify {

/// Pressure on the faces of Voronoi cells (Serrano & Espanol, Phys. Rev. E 64 (2001) 046115; Hess & Springel,
/// Mon. Not. R. Astron. Soc. 406 (2010) 2289); the wall term is ours.
///
///   m_i a_i = -sum_j a_ij [ (P_i + P_j)/2 n_ij + (P_j - P_i)/r_ij c_ij ]
///             -sum_B a_iB [ P_B n_B + (P_B - P_i)/d_i c_iB ]                                            [N]
///
/// with a_ij the area of the face between i and j, n_ij from i to j, c_ij from the middle between them to the
/// face's centroid; a_iB, d_i and c_iB, from the foot point, are those at a wall. Divided by m_i and with the
/// weights of pairs, a_ij = -2 V_i V_j r_ij R_ij, and of walls, a_iB = 2 V_i A_i, it is what stands below.
///
/// Derivation. A face's place is where it is as near to i as to j; so dV_i/dr_j = a_ij (n_ij/2 - c_ij/r_ij)
/// and the force -dE/dr_i of E = sum_k E_k(V_k), dE_k = -P_k dV_k, is sum_j a_ij (P_i - P_j) (n_ij/2 +
/// c_ij/r_ij). With sum_j a_ij n_ij = -sum_B a_iB n_B, closed cells, that is the first line, and the second
/// with P_B = P_i. What a wall gives otherwise follows from sum_f a_f x_f n_f^T = V_i I: with P_B of the same
/// linear field, taken at the foot point, a_i = -grad P/rho_i there too.
///
/// Conserves linear momentum to round-off between particles. Exact for linear pressure on any particles, up
/// to walls that prescribe it; a wall gets P_B along its normal on every part of its area.
struct VoronoiPressure {
  static constexpr SchemeInfo info{
      .id = "momentum/voronoi",
      .title = "Pressure on the faces of Voronoi cells",
      .source = "Serrano & Espanol 2001; Hess & Springel 2010; wall term ours, by the budget of Campbell 1989, Eq. 17",
      .equation =
          "m_i a_i = -sum_j a_ij [(P_i+P_j)/2 n + (P_j-P_i)/r c] - sum_B a_iB [P_B n + (P_B-P_i)/d_i c_B]\n"
          "a: area of a face, n: from i to j or out of the wall, c: from the middle of i and j or the foot "
          "point to its centroid",
      .remarks =
          "Needs pair weights voronoi; its own density is voronoi, mass over the volume of the cell. A "
          "uniform gas at rest "
          "stays at rest at any wall, on any particles, where P_B is its pressure. Nothing keeps particles "
          "in order: half of "
          "all displacements change no volume.",
      .rate = Rate::acceleration,
      .reads = {Field::density, Field::pressure},
      .kernel = {KernelWeight::gradient, KernelWeight::face_offset},
      .boundary = {BoundaryValue::pressure},
      .conserves = {Invariant::momentum},
      .work_partner = "work/voronoi",
      .claims = {.lattice_factors = 0, .steady_on_any_particles = true, .energy_with_partner = true},
      .wall_pressure_share = 1.0};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    auto const weight = -j.m() / (i.rho() * j.rho()) * W.radial();
    return (weight * ((i.P() + j.P()) * W.separation() + 2.0 * (i.P() - j.P()) * W.offset())).eval();
  }
  static auto wall(auto const& i, auto const& B) {
    return (-2.0 / i.rho() * B.A() * (B.P() * B.n() + (B.P() - i.P()) / B.d() * B.offset())).eval();
  }
};

}  // namespace sphverify
