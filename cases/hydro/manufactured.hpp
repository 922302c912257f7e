// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/gas_manufactured.hpp"
#include "cases/support/boxes.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// The manufactured flow as a problem; the walls move on their paths and prescribe what is asked.
template <int Dim>
Problem<Dim> manufactured_gas(Parameters const& p, double conductivity_scale) {
  using Point = Vector<Dim>;
  double const gamma = p.number("gamma");
  exact::GasManufactured<Dim> const exact(gamma, conductivity_scale);
  Problem<Dim> problem;
  problem.domain = slab<Dim>(0.0, 1.0);
  problem.walls = slab_walls(problem.domain);
  problem.gamma = gamma;
  problem.scalars[Field::density] = [exact](Point const& x, double t) { return exact.density(x, t); };
  problem.scalars[Field::pressure] = [exact](Point const& x, double t) { return exact.pressure(x, t); };
  problem.scalars[Field::internal_energy] = [exact](Point const& x, double t) {
    return exact.internal_energy(x, t);
  };
  problem.vectors[Field::velocity] = [exact](Point const& x, double t) { return exact.velocity(x, t); };
  problem.body_force = [exact](Point const& x, double t) { return exact.acceleration_source(x, t); };
  problem.source = [exact](Point const& x, double t) { return exact.heating_source(x, t); };
  std::string const& drive = p.one_of("drive", {"velocity", "pressure", "both"});
  for (int side = 0; side < 2; ++side) {
    Wall<Dim>& wall = problem.walls[static_cast<std::size_t>(side)];
    if (drive != "velocity") wall.pressure = problem.scalars[Field::pressure];
    if (drive == "pressure") continue;
    wall.velocity = problem.vectors[Field::velocity];
    wall.path = [exact, side](double t) -> Point { return exact.wall_position(side, t) * Point::Unit(0); };
  }
  problem.accuracy = exact.accuracy();
  problem.final_time = p.number("final_time");
  return problem;
}

/// Smooth flow between moving walls, with the sources that make it exact.
struct ManufacturedGas {
  static CaseInfo info() {
    return {
        .id = "hydro/manufactured",
        .title = "Manufactured smooth flow between moving walls",
        .source = "method of manufactured solutions (Roache 2002); the fields are ours",
        .equation =
            "Euler equations with a body force and a heat source; density and velocity from a mass "
            "coordinate m(x, t), so that mass needs no source",
        .domain = "0 <= x <= 1 at the start, other axes periodic with period 1",
        .walls =
            "both move; drive = velocity: they prescribe it; pressure: they prescribe the pressure and go "
            "with the gas; both: on their path, prescribing both",
        .initial = "the solution at t = 0",
        .kind = CaseKind::hydro,
        .parameters = {
            {"dimension", "", "1, 2 or 3", 1.0, true},
            {"gamma", "", "ratio of specific heats", 5.0 / 3.0},
            {"drive", "", "what the walls prescribe: velocity, pressure or both", std::string("velocity")},
            {"final_time", "s", "end of the run", 0.3}}};
  }
  static AnyProblem problem(Parameters const& p) {
    return in_dimension(p.integer("dimension"),
                        [&]<int Dim>() -> AnyProblem { return manufactured_gas<Dim>(p, 0.0); });
  }
};

}  // namespace sphverify
