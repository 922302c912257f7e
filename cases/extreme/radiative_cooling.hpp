// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/conduction/slab_problem.hpp"
#include "cases/exact/radiating_half_space.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// A half space whose wall loses heat by its own temperature, as that comes out in a run: where a form gets
/// the wall's temperature wrong by one per cent the wall radiates four wrong, and the fluid answers. What
/// extreme/radiative-wall leaves out.
struct RadiativeCooling {
  static CaseInfo info() {
    return {.id = "extreme/radiative-cooling",
            .title = "Half space whose wall radiates as T^4 by the temperature that the run finds there",
            .source =
                "Carslaw & Jaeger 1959, sections 2.7 to 2.9; Jaeger 1950; the wall's Volterra equation by "
                "product integration",
            .equation =
                "rho dT/dt = K d2T/dx2; K dT/dx = radiation (T^n - environment^n) at x = 0; "
                "T_w = start - 1/sqrt(pi K rho) integral of that loss(T_w(s))/sqrt(t-s) ds from 0 to t",
            .domain = "0 <= x <= 1, the near part of the half space; other axes periodic with period 1",
            .walls =
                "x = 0 loses heat by its own temperature, which its balance with the particles gives; x = 1 "
                "prescribes the exact temperature",
            .initial = "uniform",
            .kind = CaseKind::conduction,
            .parameters = {{"dimension", "", "1, 2 or 3", 1.0, true},
                           {"radiation", "W/(m^2 K^n)", "factor of the power", 10.0},
                           {"exponent", "", "n: 4 radiates, 1 is Newton's law of cooling", 4.0, true},
                           {"start", "K", "initial temperature", 1.0},
                           {"environment", "K", "temperature at which the wall loses nothing", 0.0},
                           {"conductivity", "W/(m K)", "K", 1.0},
                           {"density", "kg/m^3", "rho", 1.0},
                           {"final_time", "s", "end of the run", 0.05}}};
  }
  static AnyProblem problem(Parameters const& p) {
    double const conductivity = p.number("conductivity");
    exact::RadiatingHalfSpace const exact(p.number("radiation"), p.integer("exponent"), p.number("start"),
                                          p.number("environment"), conductivity, p.number("density"));
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      Problem<Dim> problem = conduction_problem(
          exact, slab<Dim>(0.0, 1.0), p.number("density"), [conductivity](double) { return conductivity; },
          false);
      problem.walls[0].heat_loss = HeatLoss{.flux = [exact](double T) { return exact.lost(T); },
                                            .environment = p.number("environment")};
      problem.walls[1].temperature = problem.scalars.at(Field::temperature);
      problem.walls[1].conductivity = [conductivity](Vector<Dim> const&, double) { return conductivity; };
      problem.landmarks["wall_temperature"] = [exact](double t) { return exact.wall_temperature(t); };
      problem.final_time = p.number("final_time");
      exact.wall_temperature(problem.final_time);  // complains of times that it does not know
      return problem;
    });
  }
};

}  // namespace sphverify
