#pragma once

#include <stdexcept>
#include <string>

#include "cases/exact/gas_state.hpp"
#include "cases/support/boxes.hpp"
#include "cases/support/problem.hpp"

namespace sphverify {

/// What all 1D gas cases with an exact solution `GasState state(x, t)` share: domain, two walls that
/// prescribe nothing yet, the fields, P = (gamma - 1) rho e. In a vacuum the internal energy is 0.
template <class State>
Problem<1> gas_problem(State const& state, Domain<1> const& domain, double gamma) {
  Problem<1> problem;
  problem.domain = domain;
  problem.walls = slab_walls(domain);
  problem.gamma = gamma;
  auto const scalar = [state](auto const& part) -> ScalarFunction<1> {
    return [state, part](Vector<1> const& x, double t) { return part(state(x[0], t)); };
  };
  problem.scalars[Field::density] = scalar([](exact::GasState const& s) { return s.density; });
  problem.scalars[Field::pressure] = scalar([](exact::GasState const& s) { return s.pressure; });
  problem.scalars[Field::internal_energy] = scalar([gamma](exact::GasState const& s) {
    return s.density > 0.0 ? s.pressure / ((gamma - 1.0) * s.density) : 0.0;
  });
  problem.vectors[Field::velocity] = [state](Vector<1> const& x, double t) {
    return Vector<1>(state(x[0], t).velocity);
  };
  return problem;
}

/// Makes a wall a piston on the path x(t) with the velocity u(t).
template <class Path, class Speed>
void prescribe_motion(Wall<1>& wall, Path const& path, Speed const& speed) {
  wall.path = [path](double t) { return Vector<1>(path(t)); };
  wall.velocity = [speed](Vector<1> const&, double t) { return Vector<1>(speed(t)); };
}

/// Makes a wall a piston of constant velocity from where it stands.
inline void prescribe_velocity(Wall<1>& wall, double velocity) {
  double const start = wall.point[0];
  prescribe_motion(
      wall, [=](double t) { return start + velocity * t; }, [=](double) { return velocity; });
}

/// Makes a wall prescribe a constant pressure: it goes with the gas.
inline void prescribe_pressure(Wall<1>& wall, double pressure) {
  wall.pressure = [pressure](Vector<1> const&, double) { return pressure; };
}

/// Joins the ends of the domain, and takes its walls away.
inline void make_periodic(Problem<1>& problem) {
  problem.domain.periodic[0] = true;
  problem.walls.clear();
}

/// A time that a parameter must leave the solution.
inline void require_before(double final_time, double limit, std::string const& event) {
  if (final_time < limit) return;
  throw std::invalid_argument("final_time must be less than " + std::to_string(limit) + ", when " + event +
                              ", found " + std::to_string(final_time));
}

}  // namespace sphverify
