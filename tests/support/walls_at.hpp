// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "cases/support/problem.hpp"

namespace sphverify::tests {

/// Where a wall's point is: on its path, or carried by the exact flow from its place at the start, which a
/// fourth-order Runge-Kutta method follows.
template <int Dim>
Vector<Dim> place_of(Problem<Dim> const& problem, Wall<Dim> const& wall, double time) {
  if (wall.path) return wall.path(time);
  if (problem.gamma == 0.0) return wall.point;
  // The edge of a fan is no particle's path but its own.
  if (auto const front = problem.landmarks.find("front"); front != problem.landmarks.end()) {
    return wall.point + (front->second(time) - front->second(0.0)) * wall.outward_normal;
  }
  auto const& v = problem.vectors.at(Field::velocity);
  Vector<Dim> x = wall.point;
  // Only what moves it along its normal moves a wall; where the flow has jumps their state holds from the
  // first.
  constexpr int steps = 400;
  double const h = time / steps;
  auto const speed = [&](Vector<Dim> const& y, double t) -> Vector<Dim> {
    double const beyond = t < h ? 1e-9 : 0.0;
    return v(y + beyond * wall.outward_normal, std::max(t, 1e-12)).dot(wall.outward_normal) *
           wall.outward_normal;
  };
  for (int k = 0; k < steps; ++k) {
    double const t = k * h;
    Vector<Dim> const a = speed(x, t);
    Vector<Dim> const b = speed(x + 0.5 * h * a, t + 0.5 * h);
    Vector<Dim> const c = speed(x + 0.5 * h * b, t + 0.5 * h);
    Vector<Dim> const d = speed(x + h * c, t + h);
    x += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return x;
}

/// The walls where they are at a time.
template <int Dim>
std::vector<Wall<Dim>> walls_at(Problem<Dim> const& problem, double time) {
  std::vector<Wall<Dim>> walls = problem.walls;
  for (Wall<Dim>& wall : walls) wall.point = place_of(problem, wall, time);
  return walls;
}

}  // namespace sphverify::tests
