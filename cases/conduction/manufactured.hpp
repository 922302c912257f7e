// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/conduction_manufactured.hpp"
#include "cases/support/boxes.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// Conduction in which conductivity, density and temperature all vary, with the source that makes it exact.
struct ManufacturedConduction {
  static CaseInfo info() {
    return {.id = "conduction/manufactured",
            .title = "Manufactured conduction with varying density and conductivity K(x, T)",
            .source = "method of manufactured solutions (Roache 2002); the fields are ours",
            .equation =
                "dT/dt = (1/rho) div(K grad T) + source, with T = 2 + 0.6 x + (1 + exp(-t))/4 sin(c), "
                "rho = 1.3 + 0.3 cos(b), K = scale (1 + 0.3 sin(d)) (1/2 + T^2/10); b, c, d linear in place",
            .domain = "0 <= x <= 1, other axes periodic with period 1",
            .walls = "x = 0 and x = 1 prescribe temperature, varying in place and time",
            .initial = "the solution at t = 0",
            .kind = CaseKind::conduction,
            .parameters = {{"dimension", "", "1, 2 or 3", 1.0, true},
                           {"conductivity", "W/(m K)", "scale of K", 1.0},
                           {"final_time", "s", "end of the run", 0.05}}};
  }
  static AnyProblem problem(Parameters const& p) {
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      using Point = Vector<Dim>;
      exact::ConductionManufactured<Dim> const exact(p.number("conductivity"));
      Problem<Dim> problem;
      problem.domain = slab<Dim>(0.0, 1.0);
      problem.walls = slab_walls(problem.domain);
      problem.scalars[Field::density] = [exact](Point const& x, double) { return exact.density(x); };
      problem.scalars[Field::temperature] = [exact](Point const& x, double t) {
        return exact.temperature(x, t);
      };
      problem.vectors[Field::flux] = [exact](Point const& x, double t) { return exact.flux(x, t); };
      problem.conductivity = [exact](Point const& x, double T) { return exact.conductivity(x, T); };
      problem.conductivity_depends_on_temperature = true;
      problem.source = [exact](Point const& x, double t) { return exact.source(x, t); };
      for (Wall<Dim>& wall : problem.walls) {
        wall.temperature = problem.scalars[Field::temperature];
        wall.conductivity = [exact](Point const& x, double t) {
          return exact.conductivity(x, exact.temperature(x, t));
        };
      }
      problem.accuracy = exact.accuracy();
      problem.final_time = p.number("final_time");
      return problem;
    });
  }
};

}  // namespace sphverify
