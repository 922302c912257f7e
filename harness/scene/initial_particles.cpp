// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/scene/initial_particles.hpp"

#include <stdexcept>

#include "formulations/basics/parallel.hpp"
#include "formulations/cells/voronoi_cells.hpp"
#include "harness/scene/place.hpp"

namespace sphverify {

template <int Dim>
double mean_density(Problem<Dim> const& problem, CutCell<Dim> const& cell) {
  auto const& density = problem.scalars.at(Field::density);
  return cell.mean([&](Vector<Dim> const& x) { return density(x, 0.0); });
}

namespace {

template <int Dim>
std::vector<Wall<Dim>> walls_at_start(Problem<Dim> const& problem) {
  std::vector<Wall<Dim>> walls = problem.walls;
  for (Wall<Dim>& wall : walls) {
    if (wall.path) wall.point = wall.path(0.0);
  }
  return walls;
}

}  // namespace

template <int Dim>
InitialParticles<Dim> initial_particles(Problem<Dim> const& problem, Discretisation const& discretisation, int resolution,
                                        double smoothing_ratio, int threads) {
  Layout<Dim> layout = place(problem, discretisation.layout, resolution);
  if (discretisation.layout.voronoi_masses)
    layout.volumes = voronoi_volumes(layout.positions, problem.domain, walls_at_start(problem), threads);
  InitialParticles<Dim> start;
  start.spacing = layout.spacing;
  start.particles = Particles<Dim>(layout.volumes.size(), smoothing_ratio * layout.spacing);
  start.particles.set_kernel(kernel(discretisation.kernel, Dim));
  auto const& density = problem.scalars.at(Field::density);
  auto& mass = start.particles.masses();
  for (std::size_t i = 0; i < mass.size(); ++i) mass[i] = density(layout.positions[i], 0.0) * layout.volumes[i];
  start.cut_cells = cut_cells(problem, layout, discretisation.layout);
  for (CutCell<Dim> const& cell : start.cut_cells) mass[cell.particle] = mean_density(problem, cell) * cell.volume;
  start.particles.positions() = std::move(layout.positions);
  return start;
}

namespace {

/// Per mass, of the energy that the problem releases at a point.
template <int Dim>
std::vector<double> released_energy(Problem<Dim> const& problem, Particles<Dim> const& particles) {
  std::vector<double> energy(particles.size(), 0.0);
  if (!problem.point_energy) return energy;
  double sum = 0.0;
  for (std::size_t i = 0; i < energy.size(); ++i) {
    Vector<Dim> const r = problem.domain.nearest_image(particles.positions()[i] - problem.point_energy->place);
    energy[i] = particles.kernel().value(r.norm(), particles.smoothing_length());
    sum += particles.masses()[i] * energy[i];
  }
  if (!(sum > 0.0)) throw std::invalid_argument("no particle is near the point at which energy is released");
  for (double& e : energy) e *= problem.point_energy->energy / sum;
  return energy;
}

}  // namespace

template <int Dim>
InitialGas<Dim> initial_gas(Problem<Dim> const& problem, Particles<Dim> const& particles,
                            std::vector<CutCell<Dim>> const& cut_cells) {
  std::size_t const n = particles.size();
  InitialGas<Dim> gas{VectorField<Dim>(n), std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    Vector<Dim> const x = particles.positions()[i];
    gas.velocity.set(i, problem.vectors.at(Field::velocity)(x, 0.0));
    gas.internal_energy[i] = problem.scalars.at(Field::internal_energy)(x, 0.0);
    gas.density[i] = problem.scalars.at(Field::density)(x, 0.0);
  }
  for (CutCell<Dim> const& cell : cut_cells) {
    CellState<Dim> const inside = held(cell, problem);
    gas.velocity.set(cell.particle, inside.velocity);
    gas.internal_energy[cell.particle] = inside.internal_energy;
    gas.density[cell.particle] = inside.density;
  }
  std::vector<double> const released = released_energy(problem, particles);
  for (std::size_t i = 0; i < n; ++i) gas.internal_energy[i] += released[i];
  return gas;
}

template <int Dim>
void fill_conductivity(Problem<Dim> const& problem, VectorField<Dim> const& positions,
                      std::vector<CutCell<Dim>> const& cut_cells, std::vector<double> const& temperature, int threads,
                      std::vector<double>& conductivity) {
  for_each_row(conductivity.size(), threads,
               [&](std::size_t i) { conductivity[i] = problem.conductivity(positions[i], temperature[i]); });
  for (CutCell<Dim> const& cell : cut_cells) {
    double const at = temperature[cell.particle];
    conductivity[cell.particle] =
        1.0 / cell.mean([&](Vector<Dim> const& x) { return 1.0 / problem.conductivity(x, at); });
  }
}

#define SPHVERIFY_INSTANTIATE(D)                                                                                      \
  template InitialParticles<D> initial_particles(Problem<D> const&, Discretisation const&, int, double, int);         \
  template double mean_density(Problem<D> const&, CutCell<D> const&);                                                 \
  template InitialGas<D> initial_gas(Problem<D> const&, Particles<D> const&, std::vector<CutCell<D>> const&);         \
  template void fill_conductivity(Problem<D> const&, VectorField<D> const&, std::vector<CutCell<D>> const&,            \
                                 std::vector<double> const&, int, std::vector<double>&);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
