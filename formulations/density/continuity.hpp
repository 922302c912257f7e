// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/scheme.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// The continuity equation with wall terms, for the density choice `continuity`. The report has none: this
/// one is derived as its Eq. 42 is, from the kernel estimate of -rho div v = -[div(rho v) - v.grad rho] with
/// its surface integral kept.
///
///   drho_i/dt = sum_j m_j (v_i - v_j) . grad_i W_ij + rho_B (v_i - v_B) . S_i        [kg/(m^Dim s)]
///
/// Under a uniform compression c it gives Gamma c rho, with Gamma the part of the kernel inside the fluid.
/// Not one of the compared formulations: it is what carries the density from state to state.
struct ContinuityDensity {
  static constexpr SchemeInfo info{
      .id = "density/continuity",
      .title = "Continuity equation with wall terms",
      .source = "ours, derived as Campbell 1989, Eq. 42",
      .equation = "drho_i/dt = sum_j m_j (v_i - v_j).grad_i W_ij + rho_B (v_i - v_B).S_i",
      .remarks =
          "Galilean invariant as far as v_B is; near a wall it sees only the part Gamma of a compression.",
      .rate = Rate::density,
      .reads = {Field::density, Field::velocity},
      .kernel = {KernelWeight::gradient},
      .boundary = {BoundaryValue::velocity}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return j.m() * (i.v() - j.v()).dot(W.gradient());
  }
  static auto wall(auto const& i, auto const& B) { return B.rho() * (i.v() - B.v()).dot(B.S()); }
};

}  // namespace sphverify
