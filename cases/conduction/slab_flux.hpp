// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/conduction/slab_problem.hpp"
#include "cases/exact/slab_flux.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// A uniform slab heated by a flux at one side and insulated at the other.
struct SlabFlux {
  static CaseInfo info() {
    return {.id = "conduction/slab-flux",
            .title = "Slab heated by a prescribed flux, insulated at the far side",
            .source = "Carslaw & Jaeger 1959, section 3.8",
            .equation =
                "rho dT/dt = K d2T/dx2, -K dT/dx = flux at x = 0, 0 at x = 1; series in cosines (late) or "
                "images (early)",
            .domain = "0 <= x <= 1, other axes periodic with period 1",
            .walls = "x = 0 prescribes the flux into the slab, x = 1 zero flux",
            .initial = "uniform",
            .kind = CaseKind::conduction,
            .parameters = {{"dimension", "", "1, 2 or 3", 1.0, true},
                           {"flux", "W/m^2", "heat flux into the slab at x = 0", 1.0},
                           {"initial", "K", "initial temperature", 1.0},
                           {"conductivity", "W/(m K)", "K", 1.0},
                           {"density", "kg/m^3", "rho", 1.0},
                           {"final_time", "s", "end of the run", 0.05}}};
  }
  static AnyProblem problem(Parameters const& p) {
    double const conductivity = p.number("conductivity");
    exact::SlabFlux const exact(p.number("initial"), p.number("flux"), conductivity, p.number("density"));
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      Problem<Dim> problem = conduction_problem(
          exact, slab<Dim>(0.0, 1.0), p.number("density"), [conductivity](double) { return conductivity; },
          false);
      prescribe_flux(problem.walls[0], p.number("flux"));
      prescribe_flux(problem.walls[1], 0.0);
      problem.final_time = p.number("final_time");
      return problem;
    });
  }
};

}  // namespace sphverify
