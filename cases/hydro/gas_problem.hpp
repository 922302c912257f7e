// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

#include "cases/exact/gas_state.hpp"
#include "cases/exact/require.hpp"
#include "cases/support/boxes.hpp"
#include "cases/support/problem.hpp"

namespace sphverify {

/// What all gas cases share whose exact solution `GasState state(x, t)` depends on the first coordinate only
/// and flows along it: domain, walls on all its sides that are not periodic, which prescribe nothing yet, the
/// fields, P = (gamma - 1) rho e. In a vacuum the internal energy is 0.
template <int Dim, class State>
Problem<Dim> gas_problem(State const& state, Domain<Dim> const& domain, double gamma) {
  using Point = Vector<Dim>;
  Problem<Dim> problem;
  problem.domain = domain;
  problem.walls = box_walls(domain);
  problem.gamma = gamma;
  auto const scalar = [state](auto const& part) -> ScalarFunction<Dim> {
    return [state, part](Point const& x, double t) { return part(state(x[0], t)); };
  };
  problem.scalars[Field::density] = scalar([](exact::GasState const& s) { return s.density; });
  problem.scalars[Field::pressure] = scalar([](exact::GasState const& s) { return s.pressure; });
  problem.scalars[Field::internal_energy] = scalar([gamma](exact::GasState const& s) {
    return s.density > 0.0 ? s.pressure / ((gamma - 1.0) * s.density) : 0.0;
  });
  problem.vectors[Field::velocity] = [state](Point const& x, double t) {
    return along_first_axis<Dim>(state(x[0], t).velocity);
  };
  return problem;
}

/// Makes a wall a piston whose point is on the path x(t) with the velocity u(t) along the first axis.
template <int Dim, class Path, class Speed>
void prescribe_motion(Wall<Dim>& wall, Path const& path, Speed const& speed) {
  wall.path = [path, start = wall.point](double t) {
    Vector<Dim> point = start;
    point[0] = path(t);
    return point;
  };
  wall.velocity = [speed](Vector<Dim> const&, double t) { return along_first_axis<Dim>(speed(t)); };
}

/// Makes a wall a piston of constant velocity along the first axis from where it stands.
template <int Dim>
void prescribe_velocity(Wall<Dim>& wall, double velocity) {
  double const start = wall.point[0];
  prescribe_motion(
      wall, [=](double t) { return start + velocity * t; }, [=](double) { return velocity; });
}

/// Makes a wall prescribe a constant pressure: it goes with the gas.
template <int Dim>
void prescribe_pressure(Wall<Dim>& wall, double pressure) {
  wall.pressure = [pressure](Vector<Dim> const&, double) { return pressure; };
}

/// Joins all opposite sides of the domain, and takes its walls away.
template <int Dim>
void make_periodic(Problem<Dim>& problem) {
  problem.domain.periodic.fill(true);
  problem.walls.clear();
}

/// A time that a parameter must leave the solution.
inline void require_before(double final_time, double limit, std::string const& event) {
  if (final_time < limit) return;
  throw BadValue("final_time", "less than " + exact::brief(limit) + ", when " + event,
                 exact::brief(final_time));
}

}  // namespace sphverify
