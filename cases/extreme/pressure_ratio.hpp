// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cases/exact/require.hpp"
#include "cases/hydro/riemann.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// A shock tube whose pressures differ by ten orders of magnitude. Behind the shock the gas has forgotten the
/// pressure ahead: any error of the wall or of the viscosity that is small beside the high pressure is huge
/// beside the low one, and energies there soon become negative.
struct PressureRatio {
  static CaseInfo info() {
    return {.id = "extreme/pressure-ratio",
            .title = "Shock tube of one density and a large ratio of pressures",
            .source = "Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed., chapter 4",
            .equation = "exact solution of the Euler equations, a function of (x - 1/2)/t alone",
            .domain = "0 <= x <= 1, longer where the waves need more gas until the final time",
            .walls = "two pistons at rest",
            .initial = "density 1, no velocity; pressure 1 for x < 1/2, 1/ratio beyond",
            .kind = CaseKind::hydro,
            .parameters = {{"ratio", "", "of the left pressure to the right one", 1e10},
                           {"gamma", "", "ratio of specific heats", 1.4},
                           {"final_time", "s", "end of the run", 0.35}},
            .discontinuous = true};
  }
  static AnyProblem problem(Parameters const& p) {
    Parameters tube(RiemannProblem::info().parameters);
    tube.set("left", std::vector<double>{1.0, 0.0, 1.0});
    tube.set("right",
             std::vector<double>{1.0, 0.0, 1.0 / exact::require_positive("ratio", p.number("ratio"))});
    tube.set("gamma", p.number("gamma"));
    tube.set("final_time", exact::require_positive("final_time", p.number("final_time")));
    return RiemannProblem::problem(tube);
  }
};

}  // namespace sphverify
