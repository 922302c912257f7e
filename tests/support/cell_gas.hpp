// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <memory>
#include <string_view>
#include <vector>

#include "formulations/cells/voronoi_weights.hpp"
#include "formulations/rate_operator.hpp"
#include "tests/support/cell_scenes.hpp"

// A gas in Voronoi cells, for tests of the forms that push through their faces.
namespace sphverify::tests {

/// Particles of a scene with pressures and velocities of any size, at the densities of their cells.
template <int Dim>
struct CellGas {
  Particles<Dim> particles;
  PairGeometry<Dim> geometry;
  std::vector<double> volume, surface;

  explicit CellGas(CellScene<Dim> const& scene, double smoothing_length = 0.05, std::uint64_t seed = 21)
      : particles(scene.positions.size(), smoothing_length) {
    Random random(seed);
    particles.positions() = scene.positions;
    particles.allocate(
        {Field::density, Field::pressure, Field::velocity, Field::acceleration, Field::heating});
    geometry.domain = scene.domain;
    geometry.walls = scene.walls;
    VoronoiCells<Dim> const cells = scene.cells();
    volume = cells.volume;
    surface.assign(volume.size(), 0.0);
    for (std::size_t i = 0; i < volume.size(); ++i) {
      double const rho = random.uniform(0.5, 2.0);
      particles.masses()[i] = rho * volume[i];
      particles.scalar(Field::density)[i] = rho;
      particles.scalar(Field::pressure)[i] = random.uniform(0.5, 2.0);
      particles.vector(Field::velocity).set(i, random.vector<Dim>(-1.0, 1.0));
      for (std::size_t k = cells.faces.first[i]; k < cells.faces.first[i + 1]; ++k)
        surface[i] += cells.area[k];
    }
    for (auto const& wall : cells.walls) {
      for (std::size_t c = 0; c < wall.particle.size(); ++c) surface[wall.particle[c]] += wall.area[c];
    }
  }

  /// What stands at a particle's foot point on wall w is the particle's own pressure.
  void give_walls_the_pressure_of_their_particles() {
    for (std::size_t w = 0; w < geometry.walls.size(); ++w) {
      Wall<Dim> const plane = geometry.walls[w];
      geometry.walls[w].pressure = [this, plane](Vector<Dim> const& foot, double) {
        std::size_t nearest = 0;
        for (std::size_t i = 0; i < particles.size(); ++i) {
          auto const away = [&](std::size_t n) {  // on a line all have the same foot point
            Vector<Dim> const x = particles.positions()[n];
            return ((Dim == 1 ? x : plane.foot(x)) - foot).norm();
          };
          if (away(i) < away(nearest)) nearest = i;
        }
        return particles.scalar(Field::pressure)[nearest];
      };
    }
  }

  void find_faces() {
    SmoothingLength const h(particles);
    CellGrid<Dim> const grid(particles.positions(), geometry.domain,
                             h.kernel().support_ratio() * h.largest());
    weigh_by_cells(geometry,
                   find_voronoi_cells(particles.positions(), geometry.domain, geometry.walls, 1, true), grid,
                   h, particles.masses(), particles.scalar(Field::density), 1);
  }

  std::unique_ptr<RateOperator<Dim>> evaluate(std::string_view id, Closure closure = Closure::quotient) {
    auto form = make_rate_operator<Dim>(id);
    WorkCount work;
    form->evaluate(particles, geometry, closure, 0.0, 1, work);
    return form;
  }
  Vector<Dim> force(std::size_t i) const {
    return particles.masses()[i] * particles.vector(Field::acceleration)[i];
  }
  double power(std::size_t i) const { return particles.masses()[i] * particles.scalar(Field::heating)[i]; }
};

/// Boxes of few particles, which finite differences can afford.
template <int Dim>
std::vector<CellScene<Dim>> small_cell_scenes() {
  std::vector<CellScene<Dim>> scenes;
  for (Sides const sides : {Sides::walls, Sides::mixed}) {
    for (bool const turned : {false, true}) {
      if (turned && Dim == 1) continue;
      if (Dim == 3 && sides == Sides::mixed) continue;  // would need more particles along a periodic axis
      Domain<Dim> const domain = box_of<Dim>(sides, turned);
      int const resolution = Dim == 1 ? 12 : Dim == 2 ? 6 : 4;
      for (double const amplitude : {0.1, 0.45})
        scenes.push_back({"jitter " + std::to_string(amplitude), domain, walls_of(domain),
                          jittered(domain, resolution, amplitude, 3).positions});
    }
  }
  return scenes;
}

}  // namespace sphverify::tests
