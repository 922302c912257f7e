// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/basics/vector.hpp"
#include "formulations/scheme.hpp"

namespace sphverify {

/// Work on the volumes of Voronoi cells, the partner of momentum/voronoi (Hess & Springel, Mon. Not. R.
/// Astron. Soc. 406 (2010) 2289); the wall term is ours.
///
///   m_i de_i/dt = P_i sum_j a_ij (n_ij/2 - c_ij/r_ij).(v_i - v_j)
///                 + sum_B a_iB [ P_B n_B + (P_B - P_i)/d_i c_iB ].(v_i - v_B)                           [W]
///
/// in the notation of momentum/voronoi. It is the other side of the power of that form's forces, pair by
/// pair; by closed cells it is -P_i dV_i/dt between particles and at walls of P_B = P_i.
struct VoronoiWork {
  static constexpr SchemeInfo info{
      .id = "work/voronoi",
      .title = "Work on the volumes of Voronoi cells, partner of momentum/voronoi",
      .source = "Hess & Springel 2010; wall term ours, by the budget of Campbell 1989, Eq. 40",
      .equation =
          "m_i de_i/dt = P_i sum_j a_ij (n/2 - c/r).(v_i-v_j) + sum_B a_iB [P_B n + (P_B-P_i)/d_i "
          "c_B].(v_i-v_B)",
      .remarks =
          "Conserves total energy together with momentum/voronoi, walls included. Galilean invariant. Needs "
          "pair weights voronoi.",
      .rate = Rate::internal_work,
      .reads = {Field::density, Field::pressure, Field::velocity},
      .kernel = {KernelWeight::gradient, KernelWeight::face_offset},
      .boundary = {BoundaryValue::pressure, BoundaryValue::velocity},
      .claims = {.lattice_factors = 0, .steady_on_any_particles = true}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    auto const to_face =
        (W.separation() + 2.0 * W.offset()).eval();  // twice that from j to the centroid, but for its sign
    return j.m() * i.P() / (i.rho() * j.rho()) * W.radial() * to_face.dot(i.v() - j.v());
  }
  static auto wall(auto const& i, auto const& B) {
    return 2.0 / i.rho() * B.A() * (B.P() * B.n() + (B.P() - i.P()) / B.d() * B.offset()).dot(i.v() - B.v());
  }
};

}  // namespace sphverify
