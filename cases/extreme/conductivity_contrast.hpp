// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/two_layer.hpp"
#include "cases/support/boxes.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// Two layers of which one conducts far better. The flux is continuous where conductivity and gradient jump;
/// forms that take the gradient first and multiply by K see an infinite flux there, forms that average K
/// arithmetically let the good layer lead heat through the poor one. Explicit steps are those of the good
/// layer, in which nothing happens.
struct ConductivityContrast {
  static CaseInfo info() {
    return {
        .id = "extreme/conductivity-contrast",
        .title = "Slab of two layers whose conductivities differ by orders of magnitude",
        .source = "Carslaw & Jaeger 1959, section 12.8; Ozisik, Heat Conduction, 2nd ed. 1993, chapter 7",
        .equation =
            "dT/dt = d/dx (K dT/dx); the steady state of both layers plus their slowest mode, theta from "
            "cot(theta) + S cot(theta/S) = 0, S^2 the contrast or its inverse, whichever is above 1",
        .domain = "0 <= x <= 1, other axes periodic with period 1; layers meet at x = 1/2",
        .walls = "x = 0 prescribes temperature 1, x = 1 temperature 2",
        .initial = "the solution at t = 0",
        .kind = CaseKind::conduction,
        .parameters = {{"dimension", "", "1, 2 or 3", 1.0, true},
                       {"contrast", "W/(m K)", "conductivity for x > 1/2, of that before, which is 1", 1e8},
                       {"amplitude", "K", "of the slowest mode", 1.0},
                       {"final_time", "s", "end of the run", 0.05}}};
  }
  static AnyProblem problem(Parameters const& p) {
    exact::TwoLayer const exact(1.0, 2.0, p.number("contrast"), p.number("amplitude"));
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      using Point = Vector<Dim>;
      Problem<Dim> problem;
      problem.domain = slab<Dim>(0.0, 1.0);
      problem.walls = slab_walls(problem.domain);
      problem.scalars[Field::density] = [](Point const&, double) { return 1.0; };
      problem.scalars[Field::temperature] = [exact](Point const& x, double t) {
        return exact.temperature(x[0], t);
      };
      problem.vectors[Field::flux] = [exact](Point const& x, double t) {
        return along_first_axis<Dim>(exact.flux(x[0], t));
      };
      problem.conductivity = [exact](Point const& x, double) { return exact.conductivity(x[0]); };
      for (Wall<Dim>& wall : problem.walls) {
        wall.temperature = problem.scalars[Field::temperature];
        wall.conductivity = [exact](Point const& x, double) { return exact.conductivity(x[0]); };
      }
      problem.initial_jumps = {0.5};
      // The flux and its slope, which is -dT/dt, are continuous.
      problem.features = [contrast = p.number("contrast")](double) -> Features<Dim> {
        if (contrast == 1.0) return {};
        return {plane_feature<Dim>("interface", {{Field::temperature, 1.0}}, 0.5)};
      };
      problem.landmarks["interface"] = [](double) { return 0.5; };
      problem.landmarks["decay_rate"] = [exact](double) { return exact.decay_rate(); };
      problem.accuracy = exact.accuracy();
      problem.final_time = p.number("final_time");
      return problem;
    });
  }
};

}  // namespace sphverify
