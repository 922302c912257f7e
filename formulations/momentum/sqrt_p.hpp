// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "formulations/scheme.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// Pressure gradient as a product of square roots (Campbell 1989, Eq. 20).
///
///   a_i = -2 (sqrt(P_i)/rho_i) [ sum_j m_j (sqrt(P_j)/rho_j) grad_i W_ij + sqrt(P_B) S_i ]   [m/s^2]
///
/// Conserves linear momentum to round-off between particles. Undefined for negative pressure.
struct SquareRootOfPressure {
  static constexpr SchemeInfo info{
      .id = "momentum/sqrt-p",
      .title = "Pressure gradient as a product of square roots",
      .source = "Campbell 1989, Eq. 20",
      .equation = "a_i = -2 (sqrt(P_i)/rho_i) [ sum_j m_j (sqrt(P_j)/rho_j) grad_i W_ij + sqrt(P_B) S_i ]",
      .remarks = "Undefined for P < 0, on particles and at walls alike.",
      .rate = Rate::acceleration,
      .reads = {Field::density, Field::pressure},
      .kernel = {KernelWeight::gradient},
      .boundary = {BoundaryValue::pressure},
      .conserves = {Invariant::momentum},
      .non_negative = {Field::pressure},
      .work_partner = "work/sqrt-p",
      .claims = {.energy_with_partner = true}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    using std::sqrt;
    return (-2.0 * (sqrt(i.P()) / i.rho()) * j.m() * (sqrt(j.P()) / j.rho()) * W.gradient()).eval();
  }
  static auto wall(auto const& i, auto const& B) {
    using std::sqrt;
    return (-2.0 * (sqrt(i.P()) / i.rho()) * sqrt(B.P()) * B.S()).eval();
  }
};

}  // namespace sphverify
