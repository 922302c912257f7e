// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "formulations/cells/voronoi_cells.hpp"
#include "formulations/layouts/layout.hpp"
#include "tests/support/random_particles.hpp"

// Particles in boxes, for tests of what is made of their Voronoi cells.
namespace sphverify::tests {

/// Which sides of a box are walls: all, none, or those of the first axis.
enum class Sides { walls, periodic, mixed };

template <int Dim>
struct CellScene {
  std::string name;
  Domain<Dim> domain;
  std::vector<Wall<Dim>> walls;
  VectorField<Dim> positions;

  VoronoiCells<Dim> cells(int threads = 1) const { return find_voronoi_cells(positions, domain, walls, threads); }
};

template <int Dim>
Domain<Dim> box_of(Sides sides, bool turned) {
  Domain<Dim> domain;
  for (int k = 0; k < Dim; ++k) {
    domain.lower[k] = -0.3 + 0.2 * k;
    domain.upper[k] = domain.lower[k] + 1.0 - 0.1 * k;
    domain.periodic[static_cast<std::size_t>(k)] = sides == Sides::periodic || (sides == Sides::mixed && k > 0);
  }
  if (turned && Dim > 1) {
    Random random(5);
    domain.axes = random.rotation<Dim>();
  }
  return domain;
}

/// On the sides that are not periodic.
template <int Dim>
std::vector<Wall<Dim>> walls_of(Domain<Dim> const& domain) {
  std::vector<Wall<Dim>> walls;
  for (int k = 0; k < Dim; ++k) {
    if (domain.periodic[static_cast<std::size_t>(k)]) continue;
    for (double const side : {-1.0, 1.0}) {
      Wall<Dim> wall;
      wall.point = domain.to_space(side < 0.0 ? domain.lower : domain.upper);
      wall.outward_normal = side * domain.axes.col(k);
      walls.push_back(wall);
    }
  }
  return walls;
}

/// Every layout there is and random places, in boxes of every kind, turned ones too.
template <int Dim>
std::vector<CellScene<Dim>> cell_scenes() {
  constexpr int resolution = Dim == 1 ? 40 : Dim == 2 ? 12 : 7;
  std::vector<CellScene<Dim>> scenes;
  for (Sides const sides : {Sides::walls, Sides::periodic, Sides::mixed}) {
    for (bool const turned : {false, true}) {
      if (turned && Dim == 1) continue;
      Domain<Dim> const domain = box_of<Dim>(sides, turned);
      auto const add = [&](std::string const& name, VectorField<Dim> const& positions) {
        std::string const box = sides == Sides::walls ? "walls" : sides == Sides::periodic ? "periodic" : "mixed";
        scenes.push_back({name + ", " + box + (turned ? ", turned" : ""), domain, walls_of(domain), positions});
      };
      for (double const amplitude : {0.0, 1e-12, 0.1, 0.3, 0.45})
        add("jitter " + std::to_string(amplitude), jittered(domain, resolution, amplitude, 7).positions);
      add("clumped", clumped(domain, resolution, 0.01).positions);
      add("touching", touching(domain, resolution, 1e-9).positions);
      if constexpr (Dim == 2) add("hexagonal", hexagonal(domain, resolution).positions);
      if constexpr (Dim == 3) add("close-packed", close_packed(domain, resolution).positions);
      if constexpr (Dim > 1) add("glass", glass(domain, resolution, 3).positions);
      Random random(11);
      VectorField<Dim> anywhere(300);
      for (std::size_t i = 0; i < anywhere.size(); ++i)
        anywhere.set(i, domain.to_space(domain.lower + random.vector<Dim>(0.001, 0.999).cwiseProduct(domain.extent())));
      add("random", anywhere);
      if (Dim > 1 && sides == Sides::walls) {
        // Twenty at one distance from each of a few places: as many cells meet there in one corner, but for rounding.
        VectorField<Dim> shells(6 * 20);
        for (std::size_t i = 0; i < shells.size(); ++i) {
          Vector<Dim> centre;
          for (int k = 0; k < Dim; ++k) centre[k] = 0.2 + 0.6 * static_cast<double>((i / 20 >> k) & 1u) + 0.02 * k;
          if (i / 20 > 3) centre[0] = 0.5;
          Vector<Dim> const direction = random.vector<Dim>(-1.0, 1.0).normalized();
          shells.set(i, domain.to_space(domain.lower + (centre + 0.13 * direction).cwiseProduct(Vector<Dim>::Constant(domain.extent().minCoeff()))));
        }
        add("shells", shells);
      }
    }
  }
  return scenes;
}

}  // namespace sphverify::tests
