// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "cases/support/problem.hpp"
#include "formulations/basics/expects.hpp"

namespace sphverify {

/// The axes of space turned about the third of them, and in 3D then by the same angle about the first, so
/// that none of them keeps its direction. Columns are where the axes come to lie.
template <int Dim>
typename Domain<Dim>::Axes turned_axes(double degrees) {
  static_assert(Dim > 1, "a line cannot be turned");
  double const angle = degrees * std::numbers::pi / 180.0;
  double const c = std::cos(angle);
  double const s = std::sin(angle);
  if constexpr (Dim == 2) {
    return (typename Domain<2>::Axes() << c, -s, s, c).finished();
  } else {
    typename Domain<3>::Axes about_third, about_first;
    about_third << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
    about_first << 1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c;
    return about_first * about_third;
  }
}

/// The whole scene turned about the origin: its domain, walls, fields and what drives it. A field at a place
/// is the old one at the place's old coordinates R^T x, a vector turned along: v(x) = R v_old(R^T x).
///
/// These coordinates carry the rounding of Dim products, so that `accuracy`, which is rounding where a scene
/// is turned at all, grows by as much.
/// @param axes R, orthonormal: columns are where the axes of space come to lie
/// Expects a problem without shocks, which run along the first axis of space.
template <int Dim>
Problem<Dim> turned(Problem<Dim> problem, typename Domain<Dim>::Axes const& axes) {
  expects(!problem.shocks);
  using Point = Vector<Dim>;
  auto const turn_scalar = [&axes](ScalarFunction<Dim>& f) {
    if (!f) return;
    f = [axes, old = std::move(f)](Point const& x, double t) { return old(axes.transpose() * x, t); };
  };
  auto const turn_vector = [&axes](VectorFunction<Dim>& f) {
    if (!f) return;
    f = [axes, old = std::move(f)](Point const& x, double t) -> Point {
      return axes * old(axes.transpose() * x, t);
    };
  };

  problem.domain.axes = axes * problem.domain.axes;
  for (Wall<Dim>& wall : problem.walls) {
    wall.point = axes * wall.point;
    wall.outward_normal = axes * wall.outward_normal;
    for (auto* f : {&wall.pressure, &wall.temperature, &wall.conductivity}) turn_scalar(*f);
    for (auto* f : {&wall.velocity, &wall.flux}) turn_vector(*f);
    if (wall.path) {
      wall.path = [axes, old = std::move(wall.path)](double t) -> Point { return axes * old(t); };
    }
  }
  for (auto& [field, f] : problem.scalars) turn_scalar(f);
  for (auto& [field, f] : problem.vectors) turn_vector(f);
  for (auto& [rate, f] : problem.heating) turn_scalar(f);
  turn_scalar(problem.conductivity);  // of place and temperature
  turn_scalar(problem.source);
  turn_vector(problem.body_force);
  turn_vector(problem.acceleration);
  if (problem.holds) {
    problem.holds = [axes, old = std::move(problem.holds)](Point const& x, double t) {
      return old(axes.transpose() * x, t);
    };
  }
  if (problem.features) {
    problem.features = [axes, old = std::move(problem.features)](double t) {
      Features<Dim> features = old(t);
      for (Feature<Dim>& one : features) {
        one.distance = [axes, was = std::move(one.distance)](Point const& x) {
          return was(axes.transpose() * x);
        };
      }
      return features;
    };
  }
  if (problem.point_energy) problem.point_energy->place = axes * problem.point_energy->place;
  problem.accuracy *= 1.0 + Dim;
  return problem;
}

}  // namespace sphverify
