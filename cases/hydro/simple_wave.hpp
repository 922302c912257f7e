// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/simple_wave.hpp"
#include "cases/hydro/gas_problem.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// A piston that sets off smoothly, until its shock forms.
struct SimpleWavePiston {
  static CaseInfo info() {
    return {.id = "hydro/simple-wave",
            .title = "Smoothly accelerated piston before its shock forms",
            .source = "Landau & Lifshitz, Fluid Mechanics, section 101",
            .equation =
                "u = u_p(tau), c = c0 + (gamma-1)/2 u on x = x_p(tau) + (u + c)(t - tau); "
                "u_p = speed sin^2(pi t/(2 rise_time))",
            .domain = "0 <= x <= 1, from the piston's start to a rigid wall",
            .walls =
                "left: the piston, prescribing its velocity, or (drive = pressure) the pressure there; "
                "right: at rest",
            .initial = "gas at rest",
            .kind = CaseKind::hydro,
            .parameters = {
                {"speed", "m/s", "of the piston in the end; negative: it draws back", 0.3},
                {"rise_time", "s", "until the piston has its speed", 0.5},
                {"density", "kg/m^3", "of the gas at rest", 1.0},
                {"pressure", "Pa", "of the gas at rest", 0.6},
                {"gamma", "", "ratio of specific heats", 5.0 / 3.0},
                {"drive", "", "what the piston prescribes: velocity or pressure", std::string("velocity")},
                {"final_time", "s", "end of the run", 0.5}}};
  }
  static AnyProblem problem(Parameters const& p) {
    double const gamma = p.number("gamma");
    exact::SimpleWave const wave(p.number("speed"), p.number("rise_time"), p.number("density"),
                                 p.number("pressure"), gamma);
    double const final_time = p.number("final_time");
    require_before(final_time, wave.shock_formation_time(), "the shock forms");
    double const c0 = exact::sound_speed({p.number("density"), 0.0, p.number("pressure")}, gamma);
    require_before(final_time, 1.0 / c0, "the wave reaches the far wall");
    Problem<1> problem =
        gas_problem([wave](double x, double t) { return wave.at(x, t); }, slab<1>(0.0, 1.0), gamma);
    if (p.one_of("drive", {"velocity", "pressure"}) == "velocity") {
      prescribe_motion(
          problem.walls[0], [wave](double t) { return wave.piston_position(t); },
          [wave](double t) { return wave.piston_velocity(t); });
    } else {
      problem.walls[0].pressure = [wave](Vector<1> const&, double t) {
        return wave.at(wave.piston_position(t), t).pressure;
      };
    }
    prescribe_velocity(problem.walls[1], 0.0);
    problem.landmarks["piston"] = [wave](double t) { return wave.piston_position(t); };
    problem.accuracy = wave.accuracy();
    problem.final_time = final_time;
    return problem;
  }
};

}  // namespace sphverify
