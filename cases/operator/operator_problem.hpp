// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/support/boxes.hpp"
#include "cases/support/problem.hpp"

namespace sphverify {

/// Rates on one profile f(x) in the slab [0, 1] of density 1 between walls that prescribe it: P = T = f, v =
/// f e_x, K = 1. Then dv/dt = -f', de/dt of compression = -f f', d(e + v^2/2)/dt = -(f f)', de/dt of
/// conduction = f''.
template <int Dim, class Profile>
Problem<Dim> operator_problem(Profile const& profile) {
  using Point = Vector<Dim>;
  ScalarFunction<Dim> const f = [profile](Point const& x, double) { return profile.value(x[0]); };
  VectorFunction<Dim> const f_along_x = [f](Point const& x, double t) {
    return along_first_axis<Dim>(f(x, t));
  };

  Problem<Dim> problem;
  problem.domain = slab<Dim>(0.0, 1.0);
  problem.walls = slab_walls(problem.domain);
  for (Wall<Dim>& wall : problem.walls) {
    wall.pressure = wall.temperature = f;
    wall.velocity = f_along_x;
    wall.conductivity = [](Point const&, double) { return 1.0; };
  }
  problem.scalars[Field::density] = [](Point const&, double) { return 1.0; };
  problem.scalars[Field::pressure] = problem.scalars[Field::temperature] = f;
  problem.vectors[Field::velocity] = f_along_x;
  problem.vectors[Field::flux] = [profile](Point const& x, double) {
    return along_first_axis<Dim>(-profile.first_derivative(x[0]));
  };
  problem.conductivity = [](Point const&, double) { return 1.0; };

  problem.acceleration = [profile](Point const& x, double) {
    return along_first_axis<Dim>(-profile.first_derivative(x[0]));
  };
  problem.heating[Rate::internal_work] = [profile](Point const& x, double) {
    return -profile.value(x[0]) * profile.first_derivative(x[0]);
  };
  problem.heating[Rate::total_work] = [profile](Point const& x, double) {
    return -2.0 * profile.value(x[0]) * profile.first_derivative(x[0]);
  };
  problem.heating[Rate::conduction_heating] = [profile](Point const& x, double) {
    return profile.second_derivative(x[0]);
  };
  problem.accuracy = 1e-14;
  return problem;
}

}  // namespace sphverify
