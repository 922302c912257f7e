// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/noh.hpp"
#include "cases/hydro/gas_problem.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// Cold gas that runs into a wall, an axis or a point.
struct NohProblem {
  /// In 2D and 3D errors are taken on gas that started nearer to the origin than this: the free surface,
  /// whose nearest point started at 1, changes the density of what is within the kernel's support of it. [m]
  static constexpr double undisturbed = 0.85;

  static CaseInfo info() {
    return {
        .id = "hydro/noh",
        .title = "Noh's problem: cold gas that runs into a wall",
        .source = "Noh, J. Comput. Phys. 72 (1987) 78",
        .equation =
            "behind the shock at r = (gamma-1) t/2: rho = ((gamma+1)/(gamma-1))^dimension, v = 0, e = 1/2",
        .domain = "the interval, square or cube from 0 to 1 at the start",
        .walls =
            "1D: left at rest, right a piston that moves with the gas, v = -1; 2D and 3D: the sides through "
            "the origin, at rest; the others are a free surface, and errors are taken on gas that started at "
            "r < 0.85",
        .initial = "density 1, speed 1 towards the plane, axis or point, pressure 0",
        .kind = CaseKind::hydro,
        .parameters = {{"dimension", "", "1 planar, 2 cylindrical, 3 spherical", 1.0, true},
                       {"gamma", "", "ratio of specific heats", 5.0 / 3.0},
                       {"final_time", "s", "end of the run", 0.6},
                       {"window", "m",
                        "[from, to]: errors are taken between these distances from the origin alone, as published norms "
                        "are; empty: wherever the solution holds",
                        std::vector<double>{}}},
        .discontinuous = true};
  }
  static AnyProblem problem(Parameters const& p) {
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      double const gamma = p.number("gamma");
      exact::Noh const noh(Dim, gamma);
      double const final_time = p.number("final_time");
      // Gas that started at r is shocked at the time r/(1 + D).
      require_before(
          final_time, (Dim == 1 ? 1.0 : undisturbed) / (1.0 + noh.shock_speed()),
          Dim == 1 ? "the piston reaches the shock" : "gas from the free surface reaches the shock");
      Problem<Dim> problem;
      if constexpr (Dim == 1) {
        problem = gas_problem([noh](double x, double t) { return noh.at(std::max(x, 0.0), t); },
                              slab<1>(0.0, 1.0), gamma);
        prescribe_velocity(problem.walls[0], 0.0);
        prescribe_velocity(problem.walls[1], -1.0);
        problem.shocks = [noh](double t) -> std::vector<ShockFront> {
          double const place = noh.shock_speed() * t;
          exact::GasState const behind = noh.at(0.5 * place, t);
          return {{place, 0.0, 0.0, place, behind.density, 0.0, behind.pressure}};
        };
      } else {
        problem.domain = unit_box<Dim>();
        for (int k = 0; k < Dim; ++k) {
          Wall<Dim>& wall = problem.walls.emplace_back(side_walls(problem.domain, k).front());
          prescribe_velocity(wall, 0.0);
        }
        problem.gamma = gamma;
        auto const scalar = [noh](double exact::GasState::*part) -> ScalarFunction<Dim> {
          return [noh, part](Vector<Dim> const& x, double t) { return noh.at(x.norm(), t).*part; };
        };
        problem.scalars[Field::density] = scalar(&exact::GasState::density);
        problem.scalars[Field::pressure] = scalar(&exact::GasState::pressure);
        problem.scalars[Field::internal_energy] = [noh, gamma](Vector<Dim> const& x, double t) {
          exact::GasState const s = noh.at(x.norm(), t);
          return s.pressure / ((gamma - 1.0) * s.density);
        };
        problem.vectors[Field::velocity] = [noh](Vector<Dim> const& x, double t) -> Vector<Dim> {
          return noh.at(x.norm(), t).velocity * x.normalized();
        };
        // Behind the shock the mass within r, at density ((gamma+1)/(gamma-1))^Dim, was at density 1.
        problem.holds = [noh, gamma](Vector<Dim> const& x, double t) {
          double const r = x.norm();
          bool const shocked = r < noh.shock_speed() * t;
          return (shocked ? r * (gamma + 1.0) / (gamma - 1.0) : r + t) < undisturbed;
        };
      }
      if (auto const& window = p.list("window"); !window.empty()) {
        if (window.size() != 2) throw BadValue("window", "two distances", "a list of " + std::to_string(window.size()));
        if (!(window[0] < window[1]))
          throw BadValue("window", "the nearer distance first", exact::brief(window[0]) + ", " + exact::brief(window[1]));
        problem.holds = [everywhere = problem.holds, from = window[0], to = window[1]](Vector<Dim> const& x, double t) {
          double const r = x.norm();
          return from <= r && r <= to && (!everywhere || everywhere(x, t));
        };
      }
      problem.features = [noh](double t) -> Features<Dim> {
        Feature<Dim> origin = round_feature<Dim>("start of the shock", {}, 0.0);
        origin.codimension = Dim;
        return {round_feature<Dim>("shock", whole_gas(0.0), noh.shock_speed() * t), origin};
      };
      problem.landmarks["shock"] = [noh](double t) { return noh.shock_speed() * t; };
      problem.accuracy = noh.accuracy();
      problem.final_time = final_time;
      return problem;
    });
  }
};

}  // namespace sphverify
