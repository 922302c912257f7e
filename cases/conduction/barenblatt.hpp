// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/conduction/slab_problem.hpp"
#include "cases/exact/barenblatt.hpp"
#include "cases/exact/require.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// A heat pulse with a sharp front that spreads into a medium which does not conduct when cold.
struct BarenblattPulse {
  static CaseInfo info() {
    return {.id = "conduction/barenblatt",
            .title = "Barenblatt's compact pulse of nonlinear conduction",
            .source = "Barenblatt 1952; Zel'dovich & Kompaneets 1950",
            .equation =
                "dT/dt = d2(T^m)/dx2, K = m max(T, 0)^(m-1); "
                "T = t^-a (C - k x^2 t^-2a)^(1/(m-1)), a = 1/(m+1), k = (m-1)/(2m(m+1))",
            .domain = "-half_width <= x <= half_width",
            .walls = "both prescribe T = 0; the front must stay inside",
            .initial = "the solution at start_time, from which times count",
            .kind = CaseKind::conduction,
            .parameters = {{"exponent", "", "m of u_t = (u^m)_xx, above 1", 2.0},
                           {"constant", "", "C", 1.0},
                           {"start_time", "s", "age of the pulse at t = 0", 1.0},
                           {"half_width", "m", "of the domain", 6.0},
                           {"final_time", "s", "end of the run", 1.0}}};
  }
  static AnyProblem problem(Parameters const& p) {
    exact::Barenblatt const exact(p.number("exponent"), p.number("constant"), p.number("start_time"));
    double const half_width = p.number("half_width");
    double const final_time = p.number("final_time");
    if (!(exact.front(final_time) < half_width)) {
      throw BadValue(
          "half_width",
          "above " + exact::brief(exact.front(final_time)) + ", where the front is at the final time",
          exact::brief(half_width));
    }
    Problem<1> problem = conduction_problem(
        exact, slab<1>(-half_width, half_width), 1.0, [exact](double T) { return exact.conductivity(T); },
        true);
    for (Wall<1>& wall : problem.walls) prescribe_temperature(problem, wall);
    problem.features = [exact, n = p.number("exponent") - 1.0](double t) -> Features<1> {
      return {heat_front<1>(
          n, [front = exact.front(t)](Vector<1> const& x) { return std::abs(std::abs(x[0]) - front); })};
    };
    problem.landmarks["front"] = [exact](double t) { return exact.front(t); };
    problem.final_time = final_time;
    return problem;
  }
};

}  // namespace sphverify
