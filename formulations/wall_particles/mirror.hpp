// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/wall_particles/wall_treatment.hpp"

namespace sphverify {

/// Mirrored particles: behind each wall stand the images of the particles in front of it, and in corners images of images.
/// With values continued about what the wall prescribes the sums over pairs go on as if there were no wall.
struct MirrorWalls {
  static constexpr WallTreatmentInfo info{
      .id = "mirror",
      .title = "Mirrored particles behind walls",
      .source = "ghost particles: Libersky et al. 1993; Colagrossi & Landrini 2003",
      .equation = "behind B stand j' = images of j: T_j' = 2 T_B - T_j (or T_j - 2 d_j F_B.n/K_j), P_j' = P_j (or 2 P_B - P_j), "
                  "v_j' = v_j + 2 (v_B - v_j).n n; in a corner one mirror after the other",
      .remarks = "Momentum and energy are conserved: walls give what their images exchange. As accurate as the pairs' sums are in the "
                 "bulk. What a wall prescribes is taken at foot points, of images of images beyond the corner.",
      .masses_of_sources = true};

  template <int Dim>
  static std::vector<PlacedBehind<Dim>> place(WallSurroundings<Dim> const& s) {
    std::vector<PlacedBehind<Dim>> images;
    double const support = s.support();
    for (std::uint32_t w = 0; w < s.walls.size(); ++w) {
      Wall<Dim> const& wall = s.walls[w];
      std::size_t const of_other_walls = images.size();
      auto const is_near = [&](Vector<Dim> const& x) { return wall.distance(x) > 0.0 && wall.distance(x) < support; };
      auto const add = [&](PlacedBehind<Dim> image) {
        double const d = wall.distance(image.position);
        image.continue_in({.wall = w, .foot = wall.foot(image.position), .inside = d, .behind = d});
        image.position += 2.0 * d * wall.outward_normal;
        images.push_back(std::move(image));
      };
      for (std::uint32_t j = 0; j < s.fluid.size(); ++j) {
        Vector<Dim> const x = s.fluid.positions()[j];
        if (is_near(x)) add({.position = x, .sources = {{j, 1.0}}});
      }
      for (std::size_t k = 0; k < of_other_walls; ++k) {
        bool const meets = std::abs(wall.outward_normal.dot(s.walls[images[k].mirrors[0].wall].outward_normal)) < 0.5;
        if (meets && images[k].mirror_count < Dim && is_near(images[k].position)) add(images[k]);
      }
    }
    return images;
  }
};

}  // namespace sphverify
