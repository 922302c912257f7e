// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>

#include "formulations/scheme.hpp"

namespace sphverify {

/// First pass of pressure-energy forms: the pressure as a sum of its own, smooth where density and temperature jump.
///
///   Pbar_i = (1/Gamma_i) sum_j Y_j W_ij  with j = i,   Y = m P/rho = (gamma - 1) m e   [Pa m^Dim]
///
/// Gamma is the part of the kernel inside the fluid, 1 where images fill the rest.
struct SmoothedPressure {
  static constexpr PassInfo info{.name = "smoothed-pressure",
                                 .writes = Field::pass_number,
                                 .reads = {Field::density, Field::pressure},
                                 .kernel = {KernelWeight::value},
                                 .normalised = true};

  static auto pair(auto const&, auto const& j, auto const& W) { return j.m() * j.P() / j.rho() * W.value(); }
  static double wall(auto const&, auto const&) { return 0.0; }
  static auto finish(auto const& i, auto const& sum) {
    // Where all is cold Y is 0 too: it may be divided by anything.
    return std::max((sum + i.m() * i.P() / i.rho() * i.W0()) / i.Gamma(), std::numeric_limits<double>::min());
  }
};

}  // namespace sphverify
