#pragma once

#include <array>

#include "formulations/support/domain.hpp"
#include "formulations/support/walls.hpp"

namespace sphverify {

/// The slab lower <= x <= upper along the first axis; the other axes are periodic with the same period.
template <int Dim>
Domain<Dim> slab(double lower, double upper) {
  Domain<Dim> domain{Vector<Dim>::Zero(), Vector<Dim>::Constant(upper - lower), {}};
  domain.lower[0] = lower;
  domain.upper[0] = upper;
  for (int k = 1; k < Dim; ++k) domain.periodic[k] = true;
  return domain;
}

/// The two walls of a slab that prescribe nothing yet: left, then right.
template <int Dim>
std::vector<Wall<Dim>> slab_walls(Domain<Dim> const& domain) {
  Vector<Dim> const x = Vector<Dim>::Unit(0);
  return {Wall<Dim>{.point = domain.lower, .outward_normal = -x},
          Wall<Dim>{.point = domain.lower + domain.extent()[0] * x, .outward_normal = x}};
}

}  // namespace sphverify
