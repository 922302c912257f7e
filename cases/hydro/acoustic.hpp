// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/standing_wave.hpp"
#include "cases/hydro/gas_problem.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// A standing sound wave of small amplitude.
struct AcousticWave {
  static CaseInfo info() {
    return {
        .id = "hydro/acoustic",
        .title = "Standing sound wave",
        .source = "Rayleigh, Theory of Sound II, section 249, to the second order of the amplitude",
        .equation = "u = amplitude c0 sin(mode pi x) cos(mode pi c0 t) + second order",
        .domain = "0 <= x <= 1 (boundary = periodic: 0 <= x <= 2, the wave and its mirror image)",
        .walls = "boundary = walls: both at rest; periodic: none",
        .initial = "uniform pressure and density, u = amplitude c0 sin(mode pi x)",
        .kind = CaseKind::hydro,
        .parameters = {{"amplitude", "", "largest velocity over the sound speed", 1e-4},
                       {"mode", "", "half waves between the walls", 1.0, true},
                       {"density", "kg/m^3", "of the gas at rest", 1.0},
                       {"pressure", "Pa", "of the gas at rest", 0.6},
                       {"gamma", "", "ratio of specific heats", 5.0 / 3.0},
                       {"boundary", "", "walls or periodic", std::string("walls")},
                       {"final_time", "s", "end of the run (a period is 2 at the defaults)", 0.75}},
        .remarks =
            "The period is 2/(mode c0), c0^2 = gamma pressure/density. After whole periods the wave is where "
            "it started: doing nothing scores almost 0 (errors.initial says so). The velocity goes as cos, "
            "density and pressure as sin: where either is at an extreme, the velocity after every half "
            "period, the others a quarter later, an error in the frequency enters squared and twice the "
            "order is seen. The default ends at 3/8 of a period, where neither is."};
  }
  static AnyProblem problem(Parameters const& p) {
    double const gamma = p.number("gamma");
    exact::StandingWave const wave(p.number("amplitude"), p.integer("mode"), p.number("density"),
                                   p.number("pressure"), gamma);
    bool const periodic = p.one_of("boundary", {"walls", "periodic"}) == "periodic";
    // About a wall the flow is its own mirror image, with the velocity turned round.
    auto const state = [wave](double x, double t) {
      bool const beyond = x > 1.0 || x < 0.0;
      exact::GasState s = wave.at(x > 1.0 ? 2.0 - x : x < 0.0 ? -x : x, t);
      if (beyond) s.velocity = -s.velocity;
      return s;
    };
    Problem<1> problem = gas_problem(state, slab<1>(0.0, periodic ? 2.0 : 1.0), gamma);
    for (Wall<1>& wall : problem.walls) prescribe_velocity(wall, 0.0);
    if (periodic) make_periodic(problem);
    problem.accuracy = wave.accuracy();
    problem.final_time = p.number("final_time");
    require_before(problem.final_time, wave.shock_formation_time(), "the wave breaks");
    return problem;
  }
};

}  // namespace sphverify
