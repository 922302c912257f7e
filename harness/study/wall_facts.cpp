// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/wall_facts.hpp"

#include <algorithm>

#include "harness/scene/wall_geometry.hpp"

namespace sphverify {

bool has_walls(AnyProblem const& problem) {
  return std::visit([](auto const& p) { return !p.walls.empty(); }, problem);
}

bool is_closed(AnyProblem const& problem) {
  return std::visit([](auto const& p) { return !free_side(p); }, problem);
}

bool has_free_wall(AnyProblem const& problem) {
  return std::visit(
      [](auto const& p) {
        return std::any_of(p.walls.begin(), p.walls.end(),
                           [](auto const& wall) { return wall.pressure && !wall.velocity && !wall.path; });
      },
      problem);
}

}  // namespace sphverify
