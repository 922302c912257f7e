// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/scheme.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// Kernel estimate of the pressure gradient itself (Campbell 1989, Eqs. 7 first form, 65): the control.
///
///   a_i = -(1/rho_i) [ sum_j m_j (P_j/rho_j) grad_i W_ij + P_B S_i ]   [m/s^2]
///
/// Conserves nothing, and its wall term lacks the factor 2 of the symmetric forms.
struct DirectGradient {
  static constexpr SchemeInfo info{
      .id = "momentum/direct-gradient",
      .title = "Kernel estimate of the pressure gradient (control)",
      .source = "Campbell 1989, Eqs. 7 (first form), 65",
      .equation = "a_i = -(1/rho_i) [ sum_j m_j (P_j/rho_j) grad_i W_ij + P_B S_i ]",
      .remarks = "Not conservative; the control beside the two symmetric forms.",
      .rate = Rate::acceleration,
      .reads = {Field::density, Field::pressure},
      .kernel = {KernelWeight::gradient},
      .boundary = {BoundaryValue::pressure},
      .work_partner = "work/internal-energy",
      .control = true};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return (-j.m() * (j.P() / j.rho()) / i.rho() * W.gradient()).eval();
  }
  static auto wall(auto const& i, auto const& B) { return (-B.P() / i.rho() * B.S()).eval(); }
};

}  // namespace sphverify
