// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/support/problem.hpp"

namespace sphverify::tests {

/// The same problem elsewhere in space: domain, walls, fields and all that the case knows of places.
template <int Dim>
Problem<Dim> shifted(Problem<Dim> p, Vector<Dim> const& by) {
  auto const move = [by](auto& f) {
    if (!f) return;
    f = [old = f, by](Vector<Dim> const& x, double t) { return old(x - by, t); };
  };
  Vector<Dim> const along_axes = p.domain.to_box(by);
  p.domain.lower += along_axes;
  p.domain.upper += along_axes;
  for (Wall<Dim>& wall : p.walls) {
    wall.point += by;
    if (wall.path) {
      wall.path = [old = wall.path, by](double t) -> Vector<Dim> { return old(t) + by; };
    }
    move(wall.temperature);
    move(wall.conductivity);
    move(wall.flux);
    move(wall.pressure);
    move(wall.velocity);
  }
  for (auto& [field, f] : p.scalars) move(f);
  for (auto& [field, f] : p.vectors) move(f);
  for (auto& [rate, f] : p.heating) move(f);
  move(p.conductivity);
  move(p.source);
  move(p.body_force);
  move(p.acceleration);
  move(p.holds);
  for (double& jump : p.initial_jumps) jump += along_axes[0];
  if (p.point_energy) p.point_energy->place += by;
  if (p.shocks) {
    p.shocks = [old = p.shocks, by](double t) {
      auto fronts = old(t);
      for (ShockFront& front : fronts) {
        front.position += by[0];
        front.plateau_lower += by[0];
        front.plateau_upper += by[0];
      }
      return fronts;
    };
  }
  if (p.features) {
    p.features = [old = p.features, by](double t) {
      auto features = old(t);
      for (Feature<Dim>& feature : features) {
        feature.distance = [far = feature.distance, by](Vector<Dim> const& x) { return far(x - by); };
      }
      return features;
    };
  }
  return p;
}

}  // namespace sphverify::tests
