// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/conduction/slab_problem.hpp"
#include "cases/exact/half_space_step.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// A hot wall touched at t = 0.
struct HalfSpaceStep {
  static CaseInfo info() {
    return {.id = "conduction/half-space-step",
            .title = "Half space whose wall jumps to another temperature at t = 0",
            .source = "Carslaw & Jaeger 1959, section 2.4",
            .equation = "rho dT/dt = K d2T/dx2; T = initial + (wall - initial) erfc(x / (2 sqrt(K t/rho)))",
            .domain = "0 <= x <= 1, the near part of the half space; other axes periodic with period 1",
            .walls = "x = 0 prescribes the temperature `wall`, x = 1 the exact one",
            .initial = "uniform",
            .kind = CaseKind::conduction,
            .parameters = {{"dimension", "", "1, 2 or 3", 1.0, true},
                           {"wall", "K", "temperature of the wall x = 0", 1.0},
                           {"initial", "K", "initial temperature", 0.0},
                           {"conductivity", "W/(m K)", "K", 1.0},
                           {"density", "kg/m^3", "rho", 1.0},
                           {"final_time", "s", "end of the run", 0.05}}};
  }
  static AnyProblem problem(Parameters const& p) {
    double const conductivity = p.number("conductivity");
    exact::HalfSpaceStep const exact(p.number("wall"), p.number("initial"), conductivity,
                                     p.number("density"));
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      Problem<Dim> problem = conduction_problem(
          exact, slab<Dim>(0.0, 1.0), p.number("density"), [conductivity](double) { return conductivity; },
          false);
      for (Wall<Dim>& wall : problem.walls) prescribe_temperature(problem, wall);
      problem.final_time = p.number("final_time");
      return problem;
    });
  }
};

}  // namespace sphverify
