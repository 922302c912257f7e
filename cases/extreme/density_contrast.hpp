// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

#include "cases/exact/require.hpp"
#include "cases/hydro/gas_problem.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// Two gases at rest, one as much as a million times as dense as the other, at one pressure. Nothing may
/// move, but density and energy, of which the pressure is the product, both jump where the kernel smooths
/// them.
///
/// Whether particles have unequal masses or one is the layout's choice: on `lattice` the spacing is even and
/// masses differ by the contrast; on `equal-mass` masses are one and the spacing differs, so that of N
/// particles N/(1 + contrast) are in the light gas. Beyond a contrast of N there are none.
struct DensityContrast {
  static CaseInfo info() {
    return {.id = "extreme/density-contrast",
            .title = "Two gases of very different density at rest at one pressure",
            .source = "trivial; of SPH's trouble with it: Agertz et al. 2007, Price 2008",
            .equation = "rho, e constant in each half, P constant, v = 0",
            .domain = "the interval, square or cube from 0 to 1",
            .walls =
                "on all sides; boundary = pressure: they prescribe it and are free to move; velocity: they "
                "stand still",
            .initial = "the solution",
            .kind = CaseKind::hydro,
            .parameters = {{"dimension", "", "1, 2 or 3", 1.0, true},
                           {"contrast", "", "density for x < 1/2, of that beyond, which is 1 kg/m^3", 1e6},
                           {"pressure", "Pa", "of the gas and its walls", 1.0},
                           {"gamma", "", "ratio of specific heats", 5.0 / 3.0},
                           {"boundary", "", "pressure or velocity", std::string("velocity")},
                           {"final_time", "s", "end of the run", 1.0}},
            .discontinuous = true};
  }
  static AnyProblem problem(Parameters const& p) {
    double const contrast = exact::require_positive("contrast", p.number("contrast"));
    double const pressure = exact::require_positive("pressure", p.number("pressure"));
    double const gamma = exact::require_above("gamma", p.number("gamma"), 1.0);
    std::string const& boundary = p.one_of("boundary", {"pressure", "velocity"});
    auto const state = [=](double x, double) {
      return exact::GasState{x < 0.5 ? contrast : 1.0, 0.0, pressure};
    };
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      Problem<Dim> problem = gas_problem(state, unit_box<Dim>(), gamma);
      for (Wall<Dim>& wall : problem.walls) {
        if (boundary == "pressure") prescribe_pressure(wall, pressure);
        if (boundary == "velocity") prescribe_velocity(wall, 0.0);
      }
      problem.initial_jumps = {0.5};
      problem.features = [contrast](double) -> Features<Dim> {
        if (contrast == 1.0) return {};
        return {plane_feature<Dim>("contact", density_and_energy(0.0), 0.5)};
      };
      problem.landmarks["interface"] = [](double) { return 0.5; };
      problem.accuracy = std::numeric_limits<double>::epsilon();
      problem.final_time = p.number("final_time");
      return problem;
    });
  }
};

}  // namespace sphverify
