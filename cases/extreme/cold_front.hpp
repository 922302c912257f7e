// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/conduction/slab_problem.hpp"
#include "cases/exact/cold_front.hpp"
#include "cases/exact/half_space_step.hpp"
#include "cases/exact/require.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// Heat that runs into a medium a million times colder. With n > 0 that medium conducts next to nothing:
/// ahead of the front all is as good as insulated, and a temperature that undershoots by a millionth of the
/// wall's is negative.
struct ColdFront {
  static CaseInfo info() {
    return {.id = "extreme/cold-front",
            .title = "Half space far colder than its wall, K = K0 T^n",
            .source =
                "n = 0: Carslaw & Jaeger 1959, section 2.4; n > 0: the self-similar solution of Marshak 1958 "
                "and Barenblatt 1952 for a medium that is not quite cold, by shooting",
            .equation =
                "dT/dt = d/dx (K0 T^n dT/dx); T = f(x/sqrt(K0 t)), (f^n f')' + xi f'/2 = 0, f(0) = 1, "
                "f(infinity) = 1/ratio",
            .domain = "0 <= x <= 1, the near part of the half space; other axes periodic with period 1",
            .walls = "x = 0 prescribes the temperature 1, x = 1 the exact one",
            .initial = "uniform",
            .kind = CaseKind::conduction,
            .parameters = {{"dimension", "", "1, 2 or 3", 1.0, true},
                           {"ratio", "", "of the wall's temperature, 1 K, to the medium's", 1e6},
                           {"exponent", "", "n", 0.0},
                           {"conductivity", "W/(m K)", "K0", 1.0},
                           {"final_time", "s", "end of the run", 0.05}}};
  }
  static AnyProblem problem(Parameters const& p) {
    double const cold = 1.0 / exact::require_above("ratio", p.number("ratio"), 1.0);
    double const exponent = exact::require_not_negative("exponent", p.number("exponent"));
    double const conductivity = p.number("conductivity");
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      Problem<Dim> problem;
      if (exponent == 0.0) {
        problem = conduction_problem(
            exact::HalfSpaceStep(1.0, cold, conductivity, 1.0), slab<Dim>(0.0, 1.0), 1.0,
            [conductivity](double) { return conductivity; }, false);
      } else {
        exact::ColdFront const exact(exponent, cold, conductivity);
        problem = conduction_problem(
            exact, slab<Dim>(0.0, 1.0), 1.0, [exact](double T) { return exact.conductivity(T); }, true);
        problem.features = [exact, exponent](double t) -> Features<Dim> {
          Feature<Dim> front = heat_front<Dim>(
              exponent, [foot = exact.foot(t)](Vector<Dim> const& x) { return std::abs(x[0] - foot); });
          front.width = exact.foot_width(t);
          return {front};
        };
        problem.landmarks["front"] = [exact](double t) { return exact.front(t); };
      }
      for (Wall<Dim>& wall : problem.walls) prescribe_temperature(problem, wall);
      problem.final_time = p.number("final_time");
      return problem;
    });
  }
};

}  // namespace sphverify
