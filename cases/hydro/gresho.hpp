// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/gresho.hpp"
#include "cases/exact/require.hpp"
#include "cases/hydro/gas_problem.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// A vortex that turns for ever. It is called continuous, since it is: there is no shock whose heat a
/// viscosity would have to make, and whatever viscosity there is slows the vortex, which is the error to be
/// seen.
struct GreshoVortex {
  static CaseInfo info() {
    return {
        .id = "hydro/gresho",
        .title = "Gresho's vortex, which turns for ever",
        .source =
            "Gresho & Chan, Int. J. Numer. Methods Fluids 11 (1990) 621; Liska & Wendroff, SIAM J. Sci. "
            "Comput. 25 (2003) 995; Miczek et al., Astron. Astrophys. 576 (2015) A50 for the Mach number",
        .equation =
            "v = 5 r to r = 0.2, 2 - 5 r to r = 0.4, 0 beyond, about the origin; dP/dr = rho v^2/r; at all "
            "times; continuous, with kinks",
        .domain = "-0.5 <= x, y <= 0.5",
        .walls = "boundary = periodic: none; velocity: on all sides, at rest",
        .initial = "the solution, of density 1",
        .kind = CaseKind::hydro,
        .parameters =
            {{"gamma", "", "ratio of specific heats", 1.4},
             {"mach", "",
              "largest Mach number; 0: that of a pressure of 5 Pa in the centre, 0.36 for gamma 1.4", 0.0},
             {"boundary", "", "periodic or velocity", std::string("periodic")},
             {"final_time", "s", "end of the run (one turn of the core is 1.2566)", 1.0}},
        .remarks =
            "The exact solution stands still: the initial state taken for the answer scores 0 at all times, "
            "so that errors say how fast the vortex is lost and not whether it was followed."};
  }
  static AnyProblem problem(Parameters const& p) {
    using Point = Vector<2>;
    double const gamma = exact::require_above("gamma", p.number("gamma"), 1.0);
    double const mach = exact::require_not_negative("mach", p.number("mach"));
    exact::Gresho const vortex(mach > 0.0 ? exact::Gresho::central_pressure(gamma, mach) : 5.0);
    bool const periodic = p.one_of("boundary", {"periodic", "velocity"}) == "periodic";
    Problem<2> problem;
    problem.domain = {Point::Constant(-0.5), Point::Constant(0.5), {periodic, periodic}};
    problem.walls = box_walls(problem.domain);
    for (Wall<2>& wall : problem.walls) prescribe_velocity(wall, 0.0);
    problem.gamma = gamma;
    // From the nearest of the vortices that periodic sides make.
    auto const from_centre = [domain = problem.domain](Point const& x) { return domain.nearest_image(x); };
    problem.scalars[Field::density] = [](Point const&, double) { return exact::Gresho::density; };
    problem.scalars[Field::pressure] = [=](Point const& x, double) {
      return vortex.pressure(from_centre(x).norm());
    };
    problem.scalars[Field::internal_energy] = [=](Point const& x, double) {
      return vortex.pressure(from_centre(x).norm()) / ((gamma - 1.0) * exact::Gresho::density);
    };
    problem.vectors[Field::velocity] = [=](Point const& x, double) -> Point {
      Point const r = from_centre(x);
      return vortex.angular_velocity(r.norm()) * Point(-r[1], r[0]);
    };
    // The pressure, an integral of the velocity's square, has none.
    problem.features = [=](double) -> Features<2> {
      Features<2> kinks;
      for (double const radius : {exact::Gresho::fastest, exact::Gresho::edge}) {
        kinks.push_back({"kink", {{Field::velocity, 1.0}}, [=](Point const& x) {
                           return std::abs(from_centre(x).norm() - radius);
                         }});
      }
      return kinks;
    };
    problem.accuracy = vortex.accuracy();
    problem.final_time = p.number("final_time");
    return problem;
  }
};

}  // namespace sphverify
