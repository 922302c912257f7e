// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "formulations/particles/domain.hpp"
#include "formulations/particles/particles.hpp"

namespace sphverify {

/// Where particles start, and the volume that each stands for.
template <int Dim>
struct Layout {
  VectorField<Dim> positions;
  std::vector<double> volumes;  ///< [m^Dim]; they add up to the domain's, but for particles of equal mass
  double spacing = 0.0;         ///< dx [m], the length that smoothing lengths are multiples of
  Vector<Dim> cell;             ///< size of the cells they were placed in, along the domain's axes [m]
  std::vector<double> edges{};  ///< in 1D, of the particles' own cells: one more than particles [m]
};

/// Puts particle order[n] at place n. Expects a permutation.
template <int Dim>
void reorder(Layout<Dim>& layout, std::vector<std::uint32_t> const& order);

// Every layout has a `resolution` N, and particles of about the volume of a cube with the edge extent[0]/N.
// For `lattice`, those displaced from it, `at_random` and `equal_mass` the spacing is extent[0]/N; for the others it is
// the edge of the cube that has one particle's volume, so that one ratio h/dx means the same number of
// neighbours everywhere.

/// Particles in a lattice at the centres of equal cells, `resolution` along the first axis; along the others
/// as many as make the cells most nearly cubic.
template <int Dim>
Layout<Dim> lattice(Domain<Dim> const& domain, int resolution);

/// Particles of equal mass in one dimension: where the mass from the lower end reaches (i + 1/2)/resolution
/// of the whole; their cells reach from i/resolution of it to (i + 1)/resolution. Volumes are masses over the
/// density there. Expects a density that is positive throughout.
/// @param jumps where the density jumps, ascending: the mass is then summed up to them and from them on
Layout<1> equal_mass(Domain<1> const& domain, int resolution, std::function<double(double x)> const& density,
                     std::vector<double> const& jumps = {});

/// The lattice with every coordinate displaced by a uniform deviate in +-amplitude cells, the same on every
/// machine for one seed. Volumes are Voronoi volumes in 1D, cell volumes otherwise. Expects 0 <= amplitude <
/// 0.5.
template <int Dim>
Layout<Dim> jittered(Domain<Dim> const& domain, int resolution, double amplitude, std::uint64_t seed);

/// The lattice with neighbours along the first axis moved together in pairs, each about its middle, until
/// they are `separation` cells apart; with an odd number of them the last one stays. Volumes as of
/// `jittered`. Expects 0 < separation <= 1.
template <int Dim>
Layout<Dim> clumped(Domain<Dim> const& domain, int resolution, double separation);

/// The lattice with the first particle of every row along the first axis moved to `gap` cells from the lower
/// side. Volumes as of `jittered`. Expects 0 < gap <= 0.5, and a gap that the lower side's coordinate can be
/// told from.
template <int Dim>
Layout<Dim> touching(Domain<Dim> const& domain, int resolution, double gap);

/// Rows of a triangular lattice along the first axis, every second one shifted by half a spacing, stretched
/// to fit the box. The first and last particles of the rows, and the rows along the walls, are as far from
/// the sides at both ends, and every row is matched by one of the other kind: half a turn of the box changes
/// nothing. `cell` is the spacing in a row and the distance between rows.
Layout<2> hexagonal(Domain<2> const& domain, int resolution);

/// A face-centred cubic lattice, four particles in each cell a quarter of it from its sides, stretched to fit
/// the box. Half a turn of the box about any of its axes changes nothing. `cell` is the cubic one.
Layout<3> close_packed(Domain<3> const& domain, int resolution);

/// Particles without order but evenly spread, as many as the lattice has: from random places, about one in
/// each cell, they repel each other, and their images beyond the sides, until the forces on each nearly
/// cancel. Beyond a periodic side the images are the other end of the box, beyond others its mirror image,
/// so that the density is as even at a wall as elsewhere. Relaxation by repulsion as in Diehl et al. 2015
/// (PASA 32, e048), with forces of one strength. One seed gives the same particles on every machine, of code
/// compiled without contraction of a * b + c.
/// Not for one dimension, where only the lattice is at rest.
template <int Dim>
Layout<Dim> glass(Domain<Dim> const& domain, int resolution, std::uint64_t seed);

/// Particles at random places, independent of each other, as many as the lattice has. Volumes are Voronoi volumes in 1D, equal
/// otherwise. One seed gives the same particles on every machine.
template <int Dim>
Layout<Dim> at_random(Domain<Dim> const& domain, int resolution, std::uint64_t seed);

/// How many particles `lattice` (and `jittered`, `clumped`, `touching`, `glass`, `at_random`), `hexagonal` and
/// `close_packed` would place.
template <int Dim>
double lattice_count(Domain<Dim> const& domain, int resolution);
double hexagonal_count(Domain<2> const& domain, int resolution);
double close_packed_count(Domain<3> const& domain, int resolution);

}  // namespace sphverify
