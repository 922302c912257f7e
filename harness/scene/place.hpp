// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

#include "cases/support/problem.hpp"
#include "formulations/layouts/layout_common.hpp"
#include "formulations/neighbours/locality.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// How many particles `place` would place, as a number that does not overflow: to say no before memory ends.
/// Throws std::invalid_argument for a layout that the dimension does not have, or that there is not.
template <int Dim>
double particle_count(Domain<Dim> const& domain, LayoutChoice const& layout, int resolution) {
  for (char const* id : {"lattice", "jittered", "clumped", "touching", "random"}) {
    if (layout.id == id) return lattice_count(domain, resolution);
  }
  if (layout.id == "equal-mass") {
    if constexpr (Dim == 1) return resolution;
    throw std::invalid_argument("layout equal-mass is for one dimension");
  }
  if (layout.id == "hexagonal") {
    if constexpr (Dim == 2) return hexagonal_count(domain, resolution);
    throw std::invalid_argument("layout hexagonal is for two dimensions");
  }
  if (layout.id == "close-packed") {
    if constexpr (Dim == 3) return close_packed_count(domain, resolution);
    throw std::invalid_argument("layout close-packed is for three dimensions");
  }
  if (layout.id == "glass") {
    if constexpr (Dim > 1) return lattice_count(domain, resolution);
    throw std::invalid_argument("layout glass is for two and three dimensions");
  }
  throw std::invalid_argument("no layout is named " + layout.id);
}

/// dx of a layout, without placing it [m]: along the first axis, or of a cube as large as a particle's
/// volume.
template <int Dim>
double spacing_of(Domain<Dim> const& domain, LayoutChoice const& layout, int resolution) {
  bool const packed = layout.id == "hexagonal" || layout.id == "close-packed" || layout.id == "glass";
  return packed ? edge_of_cube<Dim>(domain.volume() / particle_count(domain, layout, resolution),
                                    domain.extent().maxCoeff())
                : domain.extent()[0] / resolution;
}

/// The particles of a layout in the order in which it makes them.
template <int Dim>
Layout<Dim> place_in_order(Problem<Dim> const& problem, LayoutChoice const& layout, int resolution) {
  particle_count(problem.domain, layout, resolution);  // says what is wrong with the choice
  if (layout.id == "jittered") return jittered(problem.domain, resolution, layout.amplitude, layout.seed);
  if (layout.id == "random") return at_random(problem.domain, resolution, layout.seed);
  if (layout.id == "clumped") return clumped(problem.domain, resolution, layout.amplitude);
  if (layout.id == "touching") return touching(problem.domain, resolution, layout.amplitude);
  if constexpr (Dim == 1) {
    if (layout.id == "equal-mass") {
      auto const& density = problem.scalars.at(Field::density);
      return equal_mass(
          problem.domain, resolution, [&](double x) { return density(Vector<1>(x), 0.0); },
          problem.initial_jumps);
    }
  } else {
    if (layout.id == "glass") return glass(problem.domain, resolution, layout.seed);
  }
  if constexpr (Dim == 2) {
    if (layout.id == "hexagonal") return hexagonal(problem.domain, resolution);
  }
  if constexpr (Dim == 3) {
    if (layout.id == "close-packed") return close_packed(problem.domain, resolution);
  }
  return lattice(problem.domain, resolution);
}

/// Edge of the cells by which particles are sorted, in dx: about a usual support.
inline constexpr double cell_of_neighbours = 2.5;

/// The particles of a layout that a study names, for a problem, side by side in memory where they are in
/// space. Throws as `particle_count` does.
template <int Dim>
Layout<Dim> place(Problem<Dim> const& problem, LayoutChoice const& layout, int resolution) {
  Layout<Dim> placed = place_in_order(problem, layout, resolution);
  if constexpr (Dim > 1)
    reorder(placed, locality_order(placed.positions, problem.domain, cell_of_neighbours * placed.spacing));
  return placed;
}

}  // namespace sphverify
