// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/require.hpp"
#include "cases/exact/riemann.hpp"
#include "cases/hydro/gas_features.hpp"
#include "cases/hydro/gas_problem.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// Gas whose confining wall is taken away: a centred rarefaction into vacuum.
struct VacuumRelease {
  static CaseInfo info() {
    return {.id = "hydro/vacuum-release",
            .title = "Release into vacuum: centred rarefaction",
            .source = "Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed., section 4.6",
            .equation =
                "u = 2/(gamma+1) (c0 + (x-1)/t), c = c0 - (gamma-1)/2 u, between x = 1 - c0 t and "
                "x = 1 + 2 c0 t/(gamma-1)",
            .domain = "0 <= x <= 1 at the start",
            .walls = "left: at rest; right: prescribes pressure 0 and is free to move",
            .initial = "gas at rest",
            .kind = CaseKind::hydro,
            .parameters = {{"density", "kg/m^3", "of the gas at rest", 1.0},
                           {"pressure", "Pa", "of the gas at rest", 0.6},
                           {"gamma", "", "ratio of specific heats", 5.0 / 3.0},
                           {"final_time", "s", "end of the run", 0.5}}};
  }
  static AnyProblem problem(Parameters const& p) {
    double const gamma = p.number("gamma");
    exact::GasState const rest{p.number("density"), 0.0,
                               exact::require_positive("pressure", p.number("pressure"))};
    exact::Riemann const riemann(rest, {0.0, 0.0, 0.0}, gamma);
    double const final_time = p.number("final_time");
    require_before(final_time, 1.0 / exact::sound_speed(rest, gamma), "the wave reaches the far wall");
    double const front = riemann.waves().right_head;
    // At the front the fan's state is the limit from within; no particle is beyond it in the exact flow, and
    // one that is in a run is compared with the front.
    auto const state = [=](double x, double t) -> exact::GasState {
      if (t == 0.0) return rest;
      double const speed = (x - 1.0) / t;
      return speed < front ? riemann.at(speed) : exact::GasState{0.0, front, 0.0};
    };
    Problem<1> problem = gas_problem(state, slab<1>(0.0, 1.0), gamma);
    prescribe_velocity(problem.walls[0], 0.0);
    prescribe_pressure(problem.walls[1], 0.0);
    problem.landmarks["front"] = [front](double t) { return 1.0 + front * t; };
    problem.features = [=](double t) {
      return riemann_features(riemann, rest, {0.0, 0.0, 0.0}, gamma, 1.0, t);
    };
    problem.accuracy = riemann.accuracy();
    problem.final_time = final_time;
    return problem;
  }
};

}  // namespace sphverify
