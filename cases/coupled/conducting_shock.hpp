// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cases/exact/conducting_shock.hpp"
#include "cases/exact/require.hpp"
#include "cases/hydro/gas_problem.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// A shock of steady shape that heat conduction alone smooths, behind a hot piston.
struct ConductingShockWave {
  static CaseInfo info() {
    return {
        .id = "coupled/conducting-shock",
        .title = "Steady shock in a conducting gas, behind a hot piston",
        .source = "Rayleigh, Proc. R. Soc. A 84 (1910) 247; Landau & Lifshitz, Fluid Mechanics, section 95",
        .equation =
            "conservation of mass, momentum and energy across a profile that travels unchanged; "
            "continuous, and smooth, while the shock is weak",
        .domain = "0 <= x <= 1 at the start; the shock starts at `centre`",
        .walls =
            "left: a piston with the velocity and temperature behind the shock; right: at rest, "
            "at the temperature ahead",
        .initial = "the solution at t = 0",
        .kind = CaseKind::coupled,
        .parameters = {{"initial_pressure", "Pa", "ahead of the shock", 0.6},
                       {"pressure", "Pa", "behind the shock", 0.8},
                       {"density", "kg/m^3", "ahead of the shock", 1.0},
                       {"conductivity", "W/(m K)", "constant", 0.01},
                       {"gamma", "", "ratio of specific heats", 5.0 / 3.0},
                       {"centre", "m", "of the shock at t = 0", 0.35},
                       {"final_time", "s", "end of the run", 0.1}}};
  }
  static AnyProblem problem(Parameters const& p) {
    double const gamma = p.number("gamma");
    double const K = p.number("conductivity");
    exact::ConductingShock const exact(p.number("initial_pressure"), p.number("pressure"),
                                       p.number("density"), K, gamma, p.number("centre"));
    Problem<1> problem =
        gas_problem([exact](double x, double t) { return exact.at(x, t); }, slab<1>(0.0, 1.0), gamma);
    problem.scalars[Field::temperature] = [exact](Vector<1> const& x, double t) {
      return exact.temperature(x[0], t);
    };
    problem.vectors[Field::flux] = [exact](Vector<1> const& x, double t) {
      return Vector<1>(exact.flux(x[0], t));
    };
    problem.conductivity = [K](Vector<1> const&, double) { return K; };
    // The walls move at the speed of the gas far from the shock; what the tails of the profile make of that
    // is added to the accuracy.
    double const final_time = p.number("final_time");
    double tail = 0.0;
    for (Wall<1>& wall : problem.walls) {
      double const start = wall.point[0];
      double const velocity = start == 0.0 ? exact.piston_velocity() : 0.0;
      prescribe_velocity(wall, velocity);
      wall.temperature = problem.scalars[Field::temperature];
      wall.conductivity = [K](Vector<1> const&, double) { return K; };
      for (double const t : {0.0, final_time}) {
        tail = std::max(tail, std::abs(exact.at(start + velocity * t, t).velocity - velocity));
      }
    }
    if (!(tail < 1e-3 * exact.piston_velocity())) {
      throw BadValue(
          "centre",
          "such that the shock stays away from the walls: another centre, a shorter final_time or a "
          "smaller conductivity",
          exact::brief(p.number("centre")) + " with a tail of " + exact::brief(tail) + " m/s at a wall");
    }
    problem.landmarks["centre"] = [exact, start = p.number("centre")](double t) {
      return start + exact.shock_speed() * t;
    };
    problem.accuracy = exact.accuracy() + tail;
    problem.final_time = final_time;
    return problem;
  }
};

}  // namespace sphverify
