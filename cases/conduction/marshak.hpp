// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/conduction/slab_problem.hpp"
#include "cases/exact/marshak.hpp"
#include "cases/exact/require.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// A self-similar heat wave into a cold medium that does not conduct when cold.
struct MarshakWave {
  static CaseInfo info() {
    return {.id = "conduction/marshak",
            .title = "Self-similar heat wave from a hot wall into T = 0",
            .source = "Marshak 1958; Barenblatt 1952; Zel'dovich & Raizer, chapter X",
            .equation = "dT/dt = d/dx(K dT/dx), K = max(T, 0)^n, T(0, t) = 1; T = f(x/sqrt(t))",
            .domain = "0 <= x <= 1",
            .walls = "x = 0 prescribes T = 1, x = 1 prescribes T = 0; the front must stay inside",
            .initial = "T = 0",
            .kind = CaseKind::conduction,
            .parameters = {{"exponent", "", "n of u_t = (u^n u_x)_x, above 0", 3.0},
                           {"final_time", "s", "end of the run", 0.5}}};
  }
  static AnyProblem problem(Parameters const& p) {
    exact::Marshak const exact(p.number("exponent"));
    double const final_time = p.number("final_time");
    if (!(exact.front(final_time) < 1.0)) {
      throw BadValue(
          "final_time", "a time at which the front is inside x < 1",
          exact::brief(final_time) + " with the front at " + exact::brief(exact.front(final_time)));
    }
    Problem<1> problem = conduction_problem(
        exact, slab<1>(0.0, 1.0), 1.0, [exact](double T) { return exact.conductivity(T); }, true);
    for (Wall<1>& wall : problem.walls) prescribe_temperature(problem, wall);
    problem.features = [exact, n = p.number("exponent")](double t) -> Features<1> {
      return {
          heat_front<1>(n, [front = exact.front(t)](Vector<1> const& x) { return std::abs(x[0] - front); })};
    };
    problem.landmarks["front"] = [exact](double t) { return exact.front(t); };
    problem.final_time = final_time;
    return problem;
  }
};

}  // namespace sphverify
