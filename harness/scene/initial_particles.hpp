// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cases/support/problem.hpp"
#include "formulations/particles/particles.hpp"
#include "harness/scene/cut_cells.hpp"
#include "reports/results.hpp"

// What all runs of a case begin with, whatever moves the particles from there.
namespace sphverify {

/// Particles where a layout places them, with masses, smoothing length and kernel, and no other field yet. A particle's
/// mass is the exact initial density at its place times its volume; where a jump cuts its cell, what the cell holds.
template <int Dim>
struct InitialParticles {
  Particles<Dim> particles{0, 1.0};
  std::vector<CutCell<Dim>> cut_cells;  ///< by jumps of the initial state
  double spacing = 0.0;                 ///< [m]
};

/// @param smoothing_ratio h/dx at this resolution
/// Throws std::invalid_argument for a layout that the problem cannot have.
template <int Dim>
InitialParticles<Dim> initial_particles(Problem<Dim> const& problem, Discretisation const& discretisation, int resolution,
                                        double smoothing_ratio, int threads = 1);

/// The exact density over a cell that a jump cuts.  [kg/m^Dim]
template <int Dim>
double mean_density(Problem<Dim> const& problem, CutCell<Dim> const& cell);

/// At time 0, by particle.
template <int Dim>
struct InitialGas {
  VectorField<Dim> velocity;
  std::vector<double> internal_energy;  ///< with what is released at a point
  std::vector<double> density;
};

/// The gas at its particles: the exact initial state, what the cells hold that a jump cuts, and the energy that the
/// problem releases at a point, as much of it as the kernel about the point says, so that all of it is there and it
/// shrinks to the point as h does. Throws std::invalid_argument where no particle is near that point.
template <int Dim>
InitialGas<Dim> initial_gas(Problem<Dim> const& problem, Particles<Dim> const& particles,
                            std::vector<CutCell<Dim>> const& cut_cells);

/// K at particles of these temperatures. A cell of two materials, one behind the other, conducts as both in series:
/// resistances 1/K add up.  [W/(m K)]
template <int Dim>
void fill_conductivity(Problem<Dim> const& problem, VectorField<Dim> const& positions,
                      std::vector<CutCell<Dim>> const& cut_cells, std::vector<double> const& temperature, int threads,
                      std::vector<double>& conductivity);

}  // namespace sphverify
