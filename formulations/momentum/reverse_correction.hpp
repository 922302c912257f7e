// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/basics/vector.hpp"
#include "formulations/conduction/correction_matrix.hpp"
#include "formulations/scheme.hpp"

namespace sphverify {

/// First pass of rkgc forms: the matrix that makes gradients of linear fields exact on any particles, near 1 up to a plane wall.
///
///   L_i^-1 = (1/Gamma_i) [ sum_j m_j/rho_j (r_j - r_i) (x) grad_i W_ij + d_i n (x) S_i ]   [1]
///
/// Gamma, the part of the kernel inside the fluid, is what the bracket tends to at a plane wall as h/dx grows; in corners faces that
/// end have a moment along themselves, which is left.
struct ReverseCorrection {
  static constexpr PassInfo info{.name = "normalised-correction-matrix",
                                 .writes = Field::pass_tensor,
                                 .reads = {Field::density},
                                 .kernel = {KernelWeight::gradient},
                                 .normalised = true};

  static auto pair(auto const&, auto const& j, auto const& W) {
    return -j.m() / j.rho() * outer(W.separation(), W.gradient());  // W.separation() is r_i - r_j
  }
  static auto wall(auto const&, auto const& B) { return (B.d() * outer(B.n(), B.S())).eval(); }
  static auto finish(auto const& i, auto const& sum) { return correction_matrix((sum / i.Gamma()).eval()); }
};

/// Second pass: what is missing around a particle, which at a wall is the wall's.
///
///   sigma_i = -sum_j m_j/rho_j (L_i + L_j) grad_i W_ij   [m^-1]
struct MissingSurface {
  static constexpr PassInfo info{.name = "missing-surface",
                                 .writes = Field::pass_vector,
                                 .reads = {Field::density},
                                 .kernel = {KernelWeight::gradient}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return (-j.m() / j.rho() * ((i.pass_tensor() + j.pass_tensor()) * W.gradient())).eval();
  }
  static auto wall(auto const&, auto const& B) { return (0.0 * B.S()).eval(); }
};

}  // namespace sphverify
