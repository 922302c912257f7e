// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "formulations/particles/domain.hpp"
#include "formulations/walls/walls.hpp"

namespace sphverify {

/// A vector along the first axis.
template <int Dim>
Vector<Dim> along_first_axis(double value) {
  Vector<Dim> vector = Vector<Dim>::Zero();
  vector[0] = value;  // not value times the unit vector: an infinite one would leave NaN sideways
  return vector;
}

/// The slab lower <= x <= upper along the first axis; the other axes are periodic from 0 to `period`. [m]
template <int Dim>
Domain<Dim> slab(double lower, double upper, double period) {
  Domain<Dim> domain{Vector<Dim>::Zero(), Vector<Dim>::Constant(period), {}};
  domain.lower[0] = lower;
  domain.upper[0] = upper;
  for (int k = 1; k < Dim; ++k) domain.periodic[k] = true;
  return domain;
}

/// The slab whose period sideways is its thickness.
template <int Dim>
Domain<Dim> slab(double lower, double upper) {
  return slab<Dim>(lower, upper, upper - lower);
}

/// The box from 0 to 1 m along every axis, closed on all sides.
template <int Dim>
Domain<Dim> unit_box() {
  return {Vector<Dim>::Zero(), Vector<Dim>::Ones(), {}};
}

/// The walls on the two sides of one of the domain's axes, lower then upper, that prescribe nothing yet.
template <int Dim>
std::vector<Wall<Dim>> side_walls(Domain<Dim> const& domain, int axis) {
  Vector<Dim> const corner = domain.to_space(domain.lower);
  Vector<Dim> const direction = domain.axes.col(axis);
  return {Wall<Dim>{.point = corner, .outward_normal = -direction},
          Wall<Dim>{.point = corner + domain.extent()[axis] * direction, .outward_normal = direction}};
}

/// The two walls of a slab: left, then right.
template <int Dim>
std::vector<Wall<Dim>> slab_walls(Domain<Dim> const& domain) {
  return side_walls(domain, 0);
}

/// The walls on all sides that are not periodic, axis by axis: x lower, x upper, y lower, ...
template <int Dim>
std::vector<Wall<Dim>> box_walls(Domain<Dim> const& domain) {
  std::vector<Wall<Dim>> walls;
  for (int k = 0; k < Dim; ++k) {
    if (domain.periodic[k]) continue;
    for (Wall<Dim> const& wall : side_walls(domain, k)) walls.push_back(wall);
  }
  return walls;
}

}  // namespace sphverify
