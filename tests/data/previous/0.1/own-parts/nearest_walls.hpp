// SPDX-License-Identifier: 0BSD
#pragma once

#include <algorithm>

#include "formulations/wall_particles/dummy.hpp"

/// Layers of dummy particles, each with what the nearest particle of the fluid has.
struct NearestWalls {
  static constexpr sphverify::WallTreatmentInfo info{
      .id = "nearest",
      .title = "Layers behind walls with the values of the nearest particle",
      .source = "the example's own",
      .equation = "f~_w = f_j of the nearest j in the fluid; continued as of dummy",
      .remarks = "Of order zero in place, and the cheapest of its kind."};

  template <int Dim>
  static std::vector<sphverify::PlacedBehind<Dim>> place(sphverify::WallSurroundings<Dim> const& s) {
    auto dummies = sphverify::DummyWalls::place<Dim>(s);
    for (sphverify::PlacedBehind<Dim>& one : dummies) {
      // Where the kernel is largest, the particle is nearest.
      auto const nearest = *std::max_element(one.sources.begin(), one.sources.end(),
                                             [](auto const& a, auto const& b) { return a.second < b.second; });
      one.sources.assign(1, {nearest.first, 1.0});
    }
    return dummies;
  }
};
