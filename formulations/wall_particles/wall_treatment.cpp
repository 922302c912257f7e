// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/wall_particles/wall_treatment.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

#include "formulations/basics/readable.hpp"
#include "formulations/wall_particles/all.hpp"

namespace sphverify {

namespace {

std::vector<WallTreatmentPart>& treatments() {
  static std::vector<WallTreatmentPart> all = std::apply(
      [](auto... one) { return std::vector<WallTreatmentPart>{wall_treatment_part<decltype(one)>()...}; }, AllWallTreatments{});
  return all;
}

}  // namespace

std::vector<WallTreatmentPart> const& all_wall_treatments() { return treatments(); }

WallTreatmentPart const* find_wall_treatment(std::string_view id) {
  for (WallTreatmentPart const& part : treatments()) {
    if (part.info->id == id) return &part;
  }
  return nullptr;
}

void add_wall_treatment(WallTreatmentPart const& part) {
  std::string_view const id = part.info->id;
  if (find_wall_treatment(id) || id == "on" || id == "off")
    throw std::invalid_argument("two treatments of walls are called " + std::string(id));
  treatments().push_back(part);
}

template <int Dim>
void require_room_between_walls(std::vector<Wall<Dim>> const& walls, double support) {
  for (std::size_t a = 0; a < walls.size(); ++a) {
    for (std::size_t b = a + 1; b < walls.size(); ++b) {
      double const cosine = walls[a].outward_normal.dot(walls[b].outward_normal);
      if (std::abs(cosine) > 1e-12 && std::abs(cosine) < 1.0 - 1e-12)
        throw std::invalid_argument("walls " + std::to_string(a) + " and " + std::to_string(b) +
                                    " are oblique to each other: what stands behind walls is for boxes");
      if (cosine > 0.0 || std::abs(cosine) < 0.5) continue;
      double const apart = walls[a].distance(walls[b].point);
      if (apart >= support) continue;
      throw std::invalid_argument("walls " + std::to_string(a) + " and " + std::to_string(b) + " are " + readable(apart) +
                                  " apart, less than the support of " + readable(support) +
                                  ": what stands behind one would be seen through the other");
    }
  }
}

template void require_room_between_walls(std::vector<Wall<1>> const&, double);
template void require_room_between_walls(std::vector<Wall<2>> const&, double);
template void require_room_between_walls(std::vector<Wall<3>> const&, double);

}  // namespace sphverify
