#pragma once

#include <algorithm>
#include <cmath>

#include "formulations/support/domain.hpp"
#include "formulations/support/pair_geometry.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// Area of a wall on a side of a box [m^(Dim-1)]: the product of the box's extents along it.
template <int Dim>
double wall_area(Domain<Dim> const& domain, Wall<Dim> const& wall) {
  double area = 1.0;
  for (int k = 0; k < Dim; ++k) {
    if (std::abs(wall.outward_normal[k]) < 0.5) area *= domain.extent()[k];
  }
  return area;
}

/// The smallest face weight of any contact [1/m]; empty without contacts.
template <int Dim>
Number smallest_face_weight(PairGeometry<Dim> const& geometry) {
  Number smallest;
  for (auto const& contacts : geometry.contacts) {
    for (double const weight : contacts.face_weight) smallest = std::min(smallest.value_or(weight), weight);
  }
  return smallest;
}

}  // namespace sphverify
