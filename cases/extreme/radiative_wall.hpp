// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/conduction/slab_problem.hpp"
#include "cases/exact/radiative_wall.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// A slab whose wall loses heat as the fourth power of its temperature. The flux that the wall prescribes is
/// taken from the exact temperature of the wall: it is a function of time, and is not fed back from the
/// temperature that a run computes there. So it tests a flux that varies fast, not the stability of a
/// radiating boundary.
struct RadiativeWall {
  static CaseInfo info() {
    return {
        .id = "extreme/radiative-wall",
        .title = "Slab whose wall radiates as T^4, its flux prescribed from the exact temperature",
        .source = "method of manufactured solutions (Roache 2002); the fields are ours",
        .equation =
            "rho dT/dt = K d2T/dx2 + rho source, with T = T_w + (2/pi) G cos(pi x/2), T_w = environment + "
            "(start - environment) exp(-t/cooling_time), G = radiation (T_w^4 - environment^4)/K",
        .domain = "0 <= x <= 1, other axes periodic with period 1",
        .walls =
            "x = 0 insulated; x = 1 prescribes the flux radiation (T_w^4 - environment^4) of the exact "
            "T_w, not of the computed one",
        .initial = "the solution at t = 0",
        .kind = CaseKind::conduction,
        .parameters = {{"dimension", "", "1, 2 or 3", 1.0, true},
                       {"radiation", "W/(m^2 K^4)", "factor of the fourth power", 0.1},
                       {"start", "K", "temperature of the wall x = 1 at t = 0", 2.0},
                       {"environment", "K", "temperature into which it radiates", 1.0},
                       {"cooling_time", "s", "in which T_w falls by a factor e", 0.05},
                       {"conductivity", "W/(m K)", "K", 1.0},
                       {"density", "kg/m^3", "rho", 1.0},
                       {"final_time", "s", "end of the run", 0.05}}};
  }
  static AnyProblem problem(Parameters const& p) {
    double const conductivity = p.number("conductivity");
    double const density = p.number("density");
    exact::RadiativeWall const exact(p.number("radiation"), p.number("start"), p.number("environment"),
                                     p.number("cooling_time"), conductivity, density);
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      Problem<Dim> problem = conduction_problem(
          exact, slab<Dim>(0.0, 1.0), density, [conductivity](double) { return conductivity; }, false);
      problem.source = [exact](Vector<Dim> const& x, double t) { return exact.source(x[0], t); };
      prescribe_flux(problem.walls[0], 0.0);
      problem.walls[1].flux = [exact](Vector<Dim> const&, double t) {
        return along_first_axis<Dim>(exact.radiated(exact.wall_temperature(t)));
      };
      problem.final_time = p.number("final_time");
      return problem;
    });
  }
};

}  // namespace sphverify
