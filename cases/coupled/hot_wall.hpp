// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "cases/exact/hot_wall.hpp"
#include "cases/hydro/gas_problem.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// Gas that a hot wall heats and drives out through a free surface.
struct HotWallGas {
  static CaseInfo info() {
    return {
        .id = "coupled/hot-wall",
        .title = "Gas heated by a conducting hot wall, or a hot piston",
        .source =
            "Carslaw & Jaeger, Conduction of Heat in Solids, 2nd ed., section 2.5, in the mass coordinate; "
            "Chapman & Rubesin 1949",
        .equation =
            "at uniform pressure, K = conductivity T/initial: T = initial + (wall - initial) "
            "erfc(m/(2 sqrt(D tau))), D = rho0 K/gamma, tau = start_time + t, m the mass per area from "
            "the wall; a body force Du/Dt keeps the pressure uniform",
        .domain = "0 <= x <= 1 at the start",
        .walls =
            "left: prescribes temperature and velocity (piston_velocity); right: prescribes the pressure and "
            "the little heat flux there is, free to move",
        .initial = "the solution at t = 0",
        .kind = CaseKind::coupled,
        .parameters = {{"wall", "K", "temperature of the hot wall", 2.0},
                       {"initial", "K", "temperature of the gas far from it", 1.0},
                       {"density", "kg/m^3", "of the gas far from it", 1.0},
                       {"conductivity", "W/(m K)", "at the initial temperature", 0.01},
                       {"gamma", "", "ratio of specific heats", 5.0 / 3.0},
                       {"start_time", "s", "since when the wall is hot at t = 0", 0.5},
                       {"piston_velocity", "m/s", "of the hot wall, and of the gas with it", 0.2},
                       {"final_time", "s", "end of the run", 0.5}}};
  }
  static AnyProblem problem(Parameters const& p) {
    double const gamma = p.number("gamma");
    double const piston_velocity = p.number("piston_velocity");
    double const wall_temperature = p.number("wall");
    exact::HotWall const exact(wall_temperature, p.number("initial"), p.number("density"),
                               p.number("conductivity"), gamma, p.number("start_time"), piston_velocity);
    Problem<1> problem =
        gas_problem([exact](double x, double t) { return exact.at(x, t); }, slab<1>(0.0, 1.0), gamma);
    problem.scalars[Field::temperature] = [exact](Vector<1> const& x, double t) {
      return exact.temperature(x[0], t);
    };
    problem.vectors[Field::flux] = [exact](Vector<1> const& x, double t) {
      return Vector<1>(exact.flux(x[0], t));
    };
    problem.conductivity = [exact](Vector<1> const&, double T) {
      return exact.conductivity(std::max(T, 0.0));
    };
    problem.conductivity_depends_on_temperature = true;
    problem.body_force = [exact](Vector<1> const& x, double t) {
      return Vector<1>(exact.acceleration(x[0], t));
    };
    prescribe_velocity(problem.walls[0], piston_velocity);
    problem.walls[0].temperature = [=](Vector<1> const&, double) { return wall_temperature; };
    problem.walls[0].conductivity = [=](Vector<1> const&, double) {
      return exact.conductivity(wall_temperature);
    };
    prescribe_pressure(problem.walls[1], exact.pressure());
    // What little heat has come as far as the free surface goes on through it.
    double const surface = exact.mass_coordinate(1.0, 0.0);
    problem.walls[1].flux = [=](Vector<1> const&, double t) {
      return Vector<1>(exact.flux(exact.material_position(surface, t), t));
    };
    problem.accuracy = exact.accuracy();
    problem.final_time = p.number("final_time");
    return problem;
  }
};

}  // namespace sphverify
