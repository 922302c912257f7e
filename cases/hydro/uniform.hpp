// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/require.hpp"
#include "cases/hydro/gas_problem.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// Uniform gas at rest for ever: whatever moves it is an error.
struct UniformGas {
  static CaseInfo info() {
    return {.id = "hydro/uniform",
            .title = "Uniform gas at rest for ever",
            .source = "trivial",
            .equation = "rho, P constant, v = 0",
            .domain = "the interval, square or cube from 0 to 1",
            .walls =
                "on all sides; boundary = pressure: they prescribe it and are free to move; velocity: they "
                "stand still; periodic: none",
            .initial = "the solution",
            .kind = CaseKind::hydro,
            .parameters = {{"dimension", "", "1, 2 or 3", 1.0, true},
                           {"pressure", "Pa", "of the gas and its walls", 1.0},
                           {"density", "kg/m^3", "of the gas", 1.0},
                           {"gamma", "", "ratio of specific heats", 5.0 / 3.0},
                           {"boundary", "", "pressure, velocity or periodic", std::string("pressure")},
                           {"final_time", "s", "end of the run", 1.0}}};
  }
  static AnyProblem problem(Parameters const& p) {
    exact::GasState const rest{exact::require_positive("density", p.number("density")), 0.0,
                               exact::require_not_negative("pressure", p.number("pressure"))};
    double const gamma = exact::require_above("gamma", p.number("gamma"), 1.0);
    std::string const& boundary = p.one_of("boundary", {"pressure", "velocity", "periodic"});
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      Problem<Dim> problem = gas_problem([rest](double, double) { return rest; }, unit_box<Dim>(), gamma);
      for (Wall<Dim>& wall : problem.walls) {
        if (boundary == "pressure") prescribe_pressure(wall, rest.pressure);
        if (boundary == "velocity") prescribe_velocity(wall, 0.0);
      }
      if (boundary == "periodic") make_periodic(problem);
      problem.accuracy = 0.0;
      problem.final_time = p.number("final_time");
      return problem;
    });
  }
};

}  // namespace sphverify
