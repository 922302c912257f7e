#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "formulations/support/domain.hpp"
#include "formulations/support/particles.hpp"

namespace sphverify {

/// Where particles start, and the volume that each stands for.
template <int Dim>
struct Layout {
  VectorField<Dim> positions;
  std::vector<double> volumes;  ///< [m^Dim]; of lattices they add up to the domain's
  double spacing = 0.0;         ///< dx along the first axis [m]
  Vector<Dim> cell;  ///< size of the lattice's cells [m]; dx along the first axis, near it along others
};

/// Particles in a lattice at the centres of equal cells, `resolution` along the first axis; along the others
/// as many as make the cells most nearly cubic.
template <int Dim>
Layout<Dim> lattice(Domain<Dim> const& domain, int resolution);

/// Particles of equal mass in one dimension: where the mass from the lower end reaches (i + 1/2)/resolution
/// of the whole. Volumes are masses over the density there. Expects a density that is positive throughout.
Layout<1> equal_mass(Domain<1> const& domain, int resolution, std::function<double(double x)> const& density);

/// The lattice with every coordinate displaced by a uniform deviate in +-amplitude cells, the same on every
/// machine for one seed. Volumes are Voronoi volumes in 1D, cell volumes otherwise. Expects 0 <= amplitude <
/// 0.5.
template <int Dim>
Layout<Dim> jittered(Domain<Dim> const& domain, int resolution, double amplitude, std::uint64_t seed);

}  // namespace sphverify
