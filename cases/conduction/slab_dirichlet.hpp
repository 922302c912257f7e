// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/conduction/slab_problem.hpp"
#include "cases/exact/require.hpp"
#include "cases/exact/slab_dirichlet.hpp"
#include "cases/support/case.hpp"
#include "cases/support/turned.hpp"

namespace sphverify {

/// A slab between walls of fixed temperature.
struct SlabDirichlet {
  static CaseInfo info() {
    return {
        .id = "conduction/slab-dirichlet",
        .title = "Slab between walls of fixed temperature",
        .source = "Carslaw & Jaeger 1959, section 3.4",
        .equation =
            "rho dT/dt = K d2T/dx2; T = left + (right - left) x + sum a sin(n pi x) exp(-(n pi)^2 K t/rho)",
        .domain =
            "0 <= x <= 1, other axes periodic with period 1; all of it turned about the origin by `turn`",
        .walls = "x = 0 and x = 1 prescribe temperature",
        .initial = "the solution at t = 0",
        .kind = CaseKind::conduction,
        .parameters = {
            {"dimension", "", "1, 2 or 3", 1.0, true},
            {"left", "K", "temperature of the wall x = 0", 1.0},
            {"right", "K", "temperature of the wall x = 1", 2.0},
            {"modes", "", "[[number n, amplitude a], ...]",
             std::vector<std::vector<double>>{{1.0, 1.0}, {3.0, 0.5}}},
            {"conductivity", "W/(m K)", "K", 1.0},
            {"density", "kg/m^3", "rho", 1.0},
            {"turn", "degree",
             "by which the scene is turned in 2D; in 3D about the third axis, then as much about the first",
             0.0},
            {"final_time", "s", "end of the run", 0.05}}};
  }
  static AnyProblem problem(Parameters const& p) {
    double const conductivity = p.number("conductivity");
    exact::SlabDirichlet const exact(p.number("left"), p.number("right"), modes(p.table("modes")),
                                     conductivity, p.number("density"));
    double const turn = exact::require_finite("turn", p.number("turn"));
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      Problem<Dim> problem = conduction_problem(
          exact, slab<Dim>(0.0, 1.0), p.number("density"), [conductivity](double) { return conductivity; },
          false);
      for (Wall<Dim>& wall : problem.walls) prescribe_temperature(problem, wall);
      problem.final_time = p.number("final_time");
      if (turn == 0.0) return problem;
      if constexpr (Dim == 1) {
        throw BadValue("turn", "0 in one dimension", exact::brief(turn));
      } else {
        return turned(problem, turned_axes<Dim>(turn));
      }
    });
  }
};

}  // namespace sphverify
