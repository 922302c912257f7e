// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "cases/support/problem.hpp"
#include "formulations/particles/domain.hpp"
#include "formulations/pair_geometry.hpp"
#include "formulations/scheme.hpp"
#include "reports/extremes.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// Area of a wall on a side of a box [m^(Dim-1)]: the product of the box's extents along it.
template <int Dim>
double wall_area(Domain<Dim> const& domain, Wall<Dim> const& wall) {
  double area = 1.0;
  for (int k = 0; k < Dim; ++k) {
    if (std::abs(domain.axes.col(k).dot(wall.outward_normal)) < 0.5) area *= domain.extent()[k];
  }
  return area;
}

/// The first side of the domain that is neither periodic nor a wall, in words; empty if all are closed.
template <int Dim>
std::optional<std::string> free_side(Problem<Dim> const& problem) {
  for (int k = 0; k < Dim; ++k) {
    if (problem.domain.periodic[static_cast<std::size_t>(k)]) continue;
    for (double const side : {-1.0, 1.0}) {
      Vector<Dim> const normal = side * problem.domain.axes.col(k);
      bool const closed = std::any_of(problem.walls.begin(), problem.walls.end(), [&](Wall<Dim> const& wall) {
        return wall.outward_normal.dot(normal) > 1.0 - 1e-12;
      });
      if (!closed) return fmt::format("the {} side of axis {}", side < 0.0 ? "lower" : "upper", k + 1);
    }
  }
  return std::nullopt;
}

/// Throws std::invalid_argument when a side of the domain is neither periodic nor a wall, unless the problem
/// says where its solution holds in spite of a free surface. In one dimension gas may well be free at an end.
template <int Dim>
void require_closed(Problem<Dim> const& problem) {
  if (Dim == 1 || problem.holds || problem.walls.empty()) return;
  if (auto const side = free_side(problem)) throw std::invalid_argument("the walls do not close: " + *side + " has none");
}

/// Whether what crosses the walls as heat is known: by a form's wall terms, or where these are no more than a part of it
/// (SchemeInfo::wall_terms_are_exchange) by the flux that every wall prescribes.
template <int Dim>
bool heat_exchange_is_known(SchemeInfo const& scheme, PairGeometry<Dim> const& geometry) {
  if (scheme.wall_terms_are_exchange) return true;
  for (std::size_t w = 0; w < geometry.contacts.size(); ++w) {
    if (!geometry.walls[w].flux) return false;
  }
  return true;
}

/// The smallest face weight of any contact [1/m]; empty without contacts.
template <int Dim>
Number smallest_face_weight(PairGeometry<Dim> const& geometry) {
  Number smallest;
  for (auto const& contacts : geometry.contacts) {
    for (double const weight : contacts.face_weight) smallest = smaller(smallest.value_or(weight), weight);
  }
  return smallest;
}

}  // namespace sphverify
