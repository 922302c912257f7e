// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

#include "formulations/layouts/layout.hpp"

// What the layouts share. They take nothing but + - * / and sqrt, which IEEE 754 rounds alike everywhere, so
// that a compiler that does not contract a * b + c gives the same bits on every machine.
namespace sphverify {

/// Uniform in [-1, 1) from the top 53 bits: std::uniform_real_distribution may differ between standard
/// libraries.
inline double signed_unit_deviate(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1.0p-52 - 1.0;
}

/// As many layers as come nearest to a thickness, at least one.
inline std::size_t layers(double extent, double thickness) {
  return static_cast<std::size_t>(std::max(1L, std::lround(extent / thickness)));
}

/// The edge of a cube of this volume, by Newton's method: std::cbrt may differ between standard libraries.
/// Expects an upper bound, from which every step is downwards until rounding stops it.
template <int Dim>
double edge_of_cube(double volume, double upper_bound) {
  if constexpr (Dim == 1) return volume;
  if constexpr (Dim == 2) return std::sqrt(volume);
  double edge = upper_bound;
  while (true) {
    double const next = edge + (volume / (edge * edge) - edge) / 3.0;
    if (!(next < edge)) return edge;
    edge = next;
  }
}

/// Makes volumes Voronoi's: half the distance between a particle's two neighbours, the domain's ends taking
/// the place of a missing one. Expects particles in ascending order.
void set_voronoi_volumes(Layout<1>& layout, Domain<1> const& domain);

/// Gives every particle the same part of the box, and the layout the spacing that belongs to it.
template <int Dim>
void share_volume_equally(Layout<Dim>& layout, Domain<Dim> const& domain) {
  std::size_t const count = layout.positions.size();
  double const volume = domain.volume() / static_cast<double>(count);
  layout.volumes.assign(count, volume);
  layout.spacing = edge_of_cube<Dim>(volume, domain.extent().maxCoeff());
}

}  // namespace sphverify
