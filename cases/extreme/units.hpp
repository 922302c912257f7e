// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <variant>

#include "cases/conduction/slab_dirichlet.hpp"
#include "cases/extreme/in_units.hpp"
#include "cases/hydro/riemann.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// The slab between walls of fixed temperature, told in other units. A tolerance, a limit or a small number
/// that stands in a program without a unit shows here.
struct ConductionUnits {
  static CaseInfo info() {
    return {
        .id = "extreme/units",
        .title = "Slab between walls of fixed temperature in arbitrary units",
        .source = "conduction/slab-dirichlet, by dimensional analysis",
        .equation =
            "that of conduction/slab-dirichlet with its defaults: every length, mass, time and temperature "
            "multiplied by its unit",
        .domain = "0 <= x <= length_unit, other axes periodic with that period",
        .walls = "x = 0 and x = length_unit prescribe temperature",
        .initial = "the solution at t = 0",
        .kind = CaseKind::conduction,
        .parameters = {{"dimension", "", "1, 2 or 3", 1.0, true},
                       {"length_unit", "m", "thickness of the slab", 1.0},
                       {"mass_unit", "kg", "mass in a cube as thick as the slab", 1.0},
                       {"time_unit", "s", "time in which heat diffuses through it", 1.0},
                       {"temperature_unit", "K", "temperature of the wall x = 0", 1.0},
                       {"final_time", "time_unit", "end of the run", 0.05}}};
  }
  static AnyProblem problem(Parameters const& p) {
    Parameters slab(SlabDirichlet::info().parameters);
    slab.set("dimension", p.number("dimension"));
    slab.set("final_time", exact::require_positive("final_time", p.number("final_time")));
    Units const units{p.number("length_unit"), p.number("mass_unit"), p.number("time_unit"),
                      p.number("temperature_unit")};
    return std::visit([&](auto problem) -> AnyProblem { return in_units(std::move(problem), units); },
                      SlabDirichlet::problem(slab));
  }
};

/// Sod's shock tube, told in other units.
struct GasUnits {
  static CaseInfo info() {
    return {
        .id = "extreme/gas-units",
        .title = "Sod's shock tube in arbitrary units",
        .source = "hydro/riemann, by dimensional analysis; Sod 1978",
        .equation = "that of hydro/riemann, preset sod: every length, mass and time multiplied by its unit",
        .domain = "0 <= x <= length_unit",
        .walls = "two pistons at rest",
        .initial = "left state for x < length_unit/2, right state beyond",
        .kind = CaseKind::hydro,
        .parameters = {{"length_unit", "m", "length of the tube", 1.0},
                       {"mass_unit", "kg", "mass that it would hold at the left density", 1.0},
                       {"time_unit", "s", "length over the square root of left pressure over density", 1.0},
                       {"final_time", "time_unit", "end of the run", 0.2}},
        .discontinuous = true};
  }
  static AnyProblem problem(Parameters const& p) {
    Parameters tube(RiemannProblem::info().parameters);
    tube.set("final_time", exact::require_positive("final_time", p.number("final_time")));
    Units const units{p.number("length_unit"), p.number("mass_unit"), p.number("time_unit")};
    return in_units(std::get<Problem<1>>(RiemannProblem::problem(tube)), units);
  }
};

}  // namespace sphverify
