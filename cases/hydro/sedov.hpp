// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/require.hpp"
#include "cases/exact/sedov.hpp"
#include "cases/hydro/gas_problem.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// An explosion in the corner of a box, which is all of space by the mirrors that its walls are.
struct SedovExplosion {
  /// Where the shock is at the end unless a time is given. [m]
  static constexpr double usual_radius = 0.7;
  /// Pressure ahead over rho0 D^2 at most, for the shock to be strong.
  static constexpr double weakest = 1e-3;
  /// Errors are taken where the gas is at least this dense, relative to the gas ahead. In the hollow inside,
  /// a particle that has been misplaced stands for its mass over next to no density: any volume.
  static constexpr double thinnest = 0.1;

  static CaseInfo info() {
    return {
        .id = "hydro/sedov",
        .title = "Sedov's explosion: energy released on a plane, an axis or at a point",
        .source =
            "Sedov, Similarity and Dimensional Methods in Mechanics (1959), chapter IV; Kamm & Timmes, "
            "LA-UR-07-2849 (2007)",
        .equation =
            "self-similar: a shock at R = (energy t^2/(alpha density))^(1/(dimension+2)) into gas without "
            "pressure; ahead of it we put the gas's own; errors are taken where density > 0.1 of that ahead; "
            "alpha = 1.077486, 0.984074, 0.851072 in 1D, 2D, 3D for gamma 1.4, and 0.602935, 0.564283, "
            "0.493590 for 5/3",
        .domain =
            "the interval, square or cube from 0 to 1, of which the explosion in all of space fills as much",
        .walls = "on all sides, at rest",
        .initial = "uniform gas at rest; at the origin energy/2^dimension is released",
        .kind = CaseKind::hydro,
        .parameters =
            {{"dimension", "", "1 plane, 2 axis, 3 point", 2.0, true},
             {"energy", "J",
              "in all of space, so on both sides of the plane or all round; in 1D per area, in 2D per length",
              1.0},
             {"gamma", "", "ratio of specific heats", 5.0 / 3.0},
             {"density", "kg/m^3", "of the gas ahead", 1.0},
             {"pressure", "Pa", "of the gas ahead, which the exact solution takes for 0", 1e-6},
             {"final_time", "s", "end of the run; 0: when the shock is at 0.7", 0.0}},
        .discontinuous = true,
        .remarks =
            "In 1D tables often count the energy of one half space. Worked: gamma 1.4, density 1, R = 0.5 at "
            "t = 1 takes energy = 1.077486 x 0.5^3 = 0.134686, which is 0.0673428 for either half. Kamm & "
            "Timmes list 0.0673185 per half space, 3.6e-4 less, which brings the shock to 0.49994."};
  }
  static AnyProblem problem(Parameters const& p) {
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      using Point = Vector<Dim>;
      double const energy = p.number("energy");
      double const gamma = p.number("gamma");
      double const density = p.number("density");
      double const background = exact::require_positive("pressure", p.number("pressure"));
      exact::Sedov const sedov(Dim, gamma, density, energy);
      double const end = exact::require_not_negative("final_time", p.number("final_time"));
      double const final_time = end > 0.0 ? end : sedov.shock_time(usual_radius);
      require_before(final_time, sedov.shock_time(1.0), "the shock reaches the walls");
      double const slowest = sedov.shock_speed(final_time);
      double const ram_pressure = density * slowest * slowest;
      if (background > weakest * ram_pressure) {
        throw BadValue("pressure",
                       "at most " + exact::brief(weakest * ram_pressure) +
                           " for the shock to be strong until final_time",
                       exact::brief(background));
      }

      Problem<Dim> problem;
      problem.domain = unit_box<Dim>();
      problem.walls = box_walls(problem.domain);
      for (Wall<Dim>& wall : problem.walls) prescribe_velocity(wall, 0.0);
      problem.gamma = gamma;
      auto const state = [=](double r, double t) -> exact::GasState {
        if (r >= sedov.shock_radius(t)) return {density, 0.0, background};
        return sedov.at(r, t);
      };
      problem.scalars[Field::density] = [=](Point const& x, double t) { return state(x.norm(), t).density; };
      problem.scalars[Field::pressure] = [=](Point const& x, double t) {
        return state(x.norm(), t).pressure;
      };
      problem.scalars[Field::internal_energy] = [=](Point const& x, double t) {
        exact::GasState const s = state(x.norm(), t);
        // At the origin it is infinite, in gas of density 0: we call that 0, as in any vacuum.
        return s.density > 0.0 ? s.pressure / ((gamma - 1.0) * s.density) : 0.0;
      };
      problem.vectors[Field::velocity] = [=](Point const& x, double t) -> Point {
        return state(x.norm(), t).velocity * x.normalized();
      };
      problem.point_energy = {Point::Zero(), energy / (1 << Dim)};
      problem.holds = [=](Point const& x, double t) {
        return state(x.norm(), t).density >= thinnest * density;
      };
      problem.features = [=](double t) -> Features<Dim> {
        Feature<Dim> origin = round_feature<Dim>("explosion", {}, 0.0);
        origin.codimension = Dim;
        return {round_feature<Dim>("shock", whole_gas(0.0), sedov.shock_radius(t)), origin};
      };
      problem.landmarks["shock"] = [=](double t) { return sedov.shock_radius(t); };
      problem.landmarks["alpha"] = [alpha = sedov.energy_constant()](double) { return alpha; };
      // Pressure ahead changes the shock's speed to this order.
      problem.accuracy = sedov.accuracy() + 2.0 * gamma * background / ram_pressure;
      problem.final_time = final_time;
      return problem;
    });
  }
};

}  // namespace sphverify
