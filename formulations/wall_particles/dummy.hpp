// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>

#include "formulations/wall_particles/wall_treatment.hpp"

namespace sphverify {

/// Dummy particles: layers of a lattice stand behind each wall and go with it; what they have is extrapolated from the
/// fluid in their reach.
struct DummyWalls {
  static constexpr WallTreatmentInfo info{
      .id = "dummy",
      .title = "Layers of dummy particles behind walls, with values from the fluid",
      .source = "Adami, Hu & Adams 2012, Eqs. 23, 27",
      .equation = "f~_w = sum_f f_f W_wf / sum_f W_wf over the fluid; then T_w = 2 T_B - T~ (or T~ - (d~ + d_w) F_B.n/K~), P_w = P~ "
                  "(or 2 P_B - P~), v_w = v~ + 2 (v_B - v~).n n, m_w = rho~ dx^D",
      .remarks = "Momentum and energy are conserved: walls give what their dummies exchange. The term of Adami et al. for gravity and for "
                 "walls that accelerate, sum rho_f (g - a_w).r_wf W, is left out, and the gas slips. Masses follow the density, which "
                 "cannot be a sum over them."};

  template <int Dim>
  static std::vector<PlacedBehind<Dim>> place(WallSurroundings<Dim> const& s) {
    double const support = s.support();
    std::array<std::vector<Place>, Dim> along;
    for (int k = 0; k < Dim; ++k) along[static_cast<std::size_t>(k)] = places_along(s, k, support);
    std::vector<PlacedBehind<Dim>> dummies;
    std::array<std::size_t, Dim> at{};
    while (true) {
      add(s, along, at, dummies);
      int k = Dim - 1;
      while (k >= 0 && ++at[static_cast<std::size_t>(k)] == along[static_cast<std::size_t>(k)].size()) at[static_cast<std::size_t>(k--)] = 0;
      if (k < 0) break;
    }
    return dummies;
  }

 private:
  /// A layer of the lattice across one axis of the box.
  struct Place {
    double coordinate, size;
    int wall = -1;  ///< behind which it is; -1: none
  };

  /// The wall on a side of the box; -1 where there is none.
  template <int Dim>
  static int wall_on(WallSurroundings<Dim> const& s, int axis, double side) {
    for (std::size_t w = 0; w < s.walls.size(); ++w) {
      if (side * s.domain.axes.col(axis).dot(s.walls[w].outward_normal) > 1.0 - 1e-12) return static_cast<int>(w);
    }
    return -1;
  }

  /// As many between the sides as at the start, wherever these are now; and those behind either wall, which go with it.
  template <int Dim>
  static std::vector<Place> places_along(WallSurroundings<Dim> const& s, int axis, double support) {
    double const count = std::max(1.0, std::round(s.domain.extent()[axis] / s.spacing));
    double const size = s.domain.extent()[axis] / count;
    int const layers = static_cast<int>(std::ceil(support / size));
    auto const on = [&](int wall) { return s.domain.to_box(s.walls[static_cast<std::size_t>(wall)].point)[axis]; };
    int const below = wall_on(s, axis, -1.0);
    int const above = wall_on(s, axis, 1.0);
    double const lower = below < 0 ? s.domain.lower[axis] : on(below);
    double const upper = above < 0 ? s.domain.upper[axis] : on(above);
    std::vector<Place> places;
    for (int n = 0; below >= 0 && n < layers; ++n) places.push_back({lower - (n + 0.5) * size, size, below});
    double const between = (upper - lower) / count;
    for (int n = 0; n < static_cast<int>(count); ++n) places.push_back({lower + (n + 0.5) * between, between, -1});
    for (int n = 0; above >= 0 && n < layers; ++n) places.push_back({upper + (n + 0.5) * size, size, above});
    return places;
  }

  template <int Dim>
  static void add(WallSurroundings<Dim> const& s, auto const& along, auto const& at, std::vector<PlacedBehind<Dim>>& dummies) {
    Vector<Dim> x;
    double volume = 1.0;
    bool is_behind = false;
    for (int k = 0; k < Dim; ++k) {
      Place const& place = along[static_cast<std::size_t>(k)][at[static_cast<std::size_t>(k)]];
      x[k] = place.coordinate;
      volume *= place.size;
      is_behind = is_behind || place.wall >= 0;
    }
    if (!is_behind) return;
    PlacedBehind<Dim> dummy{.position = s.domain.to_space(x), .sources = {}, .volume = volume};
    SmoothingLength const h = s.lengths();
    double sum = 0.0;
    s.grid.for_each_within_reach(dummy.position, [&](std::uint32_t j, Vector<Dim> const&, double distance) {
      double const weight = h.kernel().value(distance, h(j));
      if (weight == 0.0) return;
      dummy.sources.emplace_back(j, weight);
      sum += weight;
    });
    if (!(sum > 0.0)) return;  // no fluid sees it either
    for (auto& source : dummy.sources) source.second /= sum;
    // The place in the fluid of which the dummy's is the image, and its way through the mirrors.
    Vector<Dim> image = dummy.position;
    for (int k = 0; k < Dim; ++k) {
      int const w = along[static_cast<std::size_t>(k)][at[static_cast<std::size_t>(k)]].wall;
      if (w >= 0) image += 2.0 * s.walls[static_cast<std::size_t>(w)].distance(image) * s.walls[static_cast<std::size_t>(w)].outward_normal;
    }
    for (int k = 0; k < Dim; ++k) {
      int const w = along[static_cast<std::size_t>(k)][at[static_cast<std::size_t>(k)]].wall;
      if (w < 0) continue;
      Wall<Dim> const& wall = s.walls[static_cast<std::size_t>(w)];
      double inside = 0.0;
      for (auto const& [j, weight] : dummy.sources) inside += weight * wall.distance(s.fluid.positions()[j]);
      dummy.continue_in({.wall = static_cast<std::uint32_t>(w),
                         .foot = wall.foot(image),
                         .inside = inside,
                         .behind = wall.distance(image)});
      image += 2.0 * wall.distance(image) * wall.outward_normal;
    }
    dummies.push_back(std::move(dummy));
  }
};

}  // namespace sphverify
