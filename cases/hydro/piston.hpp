// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/piston_shock.hpp"
#include "cases/hydro/gas_problem.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// What the two pistons share: gas at rest in front of a wall at x = 0 that drives a single shock.
struct PistonCase {
  static CaseInfo info(std::string const& id, std::string const& title, std::string const& walls) {
    return {
        .id = id,
        .title = title,
        .source = "Rankine-Hugoniot (Landau & Lifshitz, Fluid Mechanics, section 89)",
        .equation = "a shock of speed D from x = 0, behind it the piston's velocity and the given pressure",
        .domain =
            "0 <= x <= 1, from the piston's start to a rigid wall; other axes periodic with period 0.25",
        .walls = walls,
        .initial = "gas at rest",
        .kind = CaseKind::hydro,
        .parameters = {{"dimension", "", "1, 2 or 3", 1.0, true},
                       {"initial_pressure", "Pa", "ahead of the shock", 0.5},
                       {"pressure", "Pa", "behind the shock", 1.0},
                       {"density", "kg/m^3", "ahead of the shock", 1.0},
                       {"gamma", "", "ratio of specific heats", 5.0 / 3.0},
                       {"final_time", "s", "end of the run", 0.5}},
        .discontinuous = true};
  }

  /// The problem, whose left wall prescribes nothing yet.
  template <int Dim>
  static Problem<Dim> problem(Parameters const& p, exact::PistonShock const& shock) {
    double const gamma = p.number("gamma");
    double const initial_pressure = p.number("initial_pressure");
    double const pressure = p.number("pressure");
    // Nothing happens sideways: a quarter of the length there keeps the particles few.
    Problem<Dim> problem =
        gas_problem([shock](double x, double t) { return shock.at(x, t); }, slab<Dim>(0.0, 1.0, 0.25), gamma);
    prescribe_velocity(problem.walls[1], 0.0);
    problem.shocks = [=](double t) -> std::vector<ShockFront> {
      double const place = shock.shock_speed() * t;
      return {{place, initial_pressure, shock.piston_velocity() * t, place, shock.post_density(),
               shock.piston_velocity(), pressure}};
    };
    problem.features = [shock](double t) -> Features<Dim> {
      if (shock.piston_velocity() == 0.0) return {};
      return {plane_feature<Dim>("shock", whole_gas(0.0), shock.shock_speed() * t),
              plane_feature<Dim>("start of the shock", {}, shock.piston_velocity() * t)};
    };
    problem.landmarks["shock"] = [shock](double t) { return shock.shock_speed() * t; };
    problem.landmarks["piston"] = [shock](double t) { return shock.piston_velocity() * t; };
    problem.accuracy = shock.accuracy();
    problem.final_time = p.number("final_time");
    require_before(problem.final_time, 1.0 / shock.shock_speed(), "the shock reaches the far wall");
    return problem;
  }

  static exact::PistonShock exact_of(Parameters const& p) {
    return {p.number("initial_pressure"), p.number("pressure"), p.number("density"), p.number("gamma")};
  }
};

/// A piston of prescribed velocity drives a shock.
struct PistonOfVelocity {
  static CaseInfo info() {
    return PistonCase::info("hydro/piston-velocity", "Shock driven by a piston of prescribed velocity",
                            "left: the piston's velocity, that of the gas behind the shock; right: at rest");
  }
  static AnyProblem problem(Parameters const& p) {
    exact::PistonShock const shock = PistonCase::exact_of(p);
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      Problem<Dim> problem = PistonCase::problem<Dim>(p, shock);
      prescribe_velocity(problem.walls[0], shock.piston_velocity());
      return problem;
    });
  }
};

/// A prescribed pressure drives the same shock through a surface that is free to move.
struct PistonOfPressure {
  static CaseInfo info() {
    return PistonCase::info("hydro/piston-pressure", "Shock driven by a prescribed pressure",
                            "left: the pressure behind the shock, free to move with the gas; right: at rest");
  }
  static AnyProblem problem(Parameters const& p) {
    exact::PistonShock const shock = PistonCase::exact_of(p);
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      Problem<Dim> problem = PistonCase::problem<Dim>(p, shock);
      prescribe_pressure(problem.walls[0], p.number("pressure"));
      return problem;
    });
  }
};

}  // namespace sphverify
