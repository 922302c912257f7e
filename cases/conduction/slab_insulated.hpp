// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/conduction/slab_problem.hpp"
#include "cases/exact/slab_insulated.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// A slab between insulated walls.
struct SlabInsulated {
  static CaseInfo info() {
    return {.id = "conduction/slab-insulated",
            .title = "Slab between insulated walls",
            .source = "Carslaw & Jaeger 1959, section 3.5",
            .equation = "rho dT/dt = K d2T/dx2; T = mean + sum a cos(n pi x) exp(-(n pi)^2 K t/rho)",
            .domain = "0 <= x <= 1, other axes periodic with period 1",
            .walls = "x = 0 and x = 1 prescribe zero flux",
            .initial = "the solution at t = 0",
            .kind = CaseKind::conduction,
            .parameters = {
                {"dimension", "", "1, 2 or 3", 1.0, true},
                {"mean", "K", "mean temperature", 1.0},
                {"modes", "", "[[number n, amplitude a], ...]", std::vector<std::vector<double>>{{1.0, 0.5}}},
                {"conductivity", "W/(m K)", "K", 1.0},
                {"density", "kg/m^3", "rho", 1.0},
                {"final_time", "s", "end of the run", 0.05}}};
  }
  static AnyProblem problem(Parameters const& p) {
    double const conductivity = p.number("conductivity");
    exact::SlabInsulated const exact(p.number("mean"), modes(p.table("modes")), conductivity,
                                     p.number("density"));
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      Problem<Dim> problem = conduction_problem(
          exact, slab<Dim>(0.0, 1.0), p.number("density"), [conductivity](double) { return conductivity; },
          false);
      for (Wall<Dim>& wall : problem.walls) prescribe_flux(wall, 0.0);
      problem.final_time = p.number("final_time");
      return problem;
    });
  }
};

}  // namespace sphverify
