// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "formulations/particles/domain.hpp"
#include "formulations/walls/walls.hpp"
#include "reports/json/node.hpp"

namespace sphverify {

/// A direction (unit vector) in which particles meet neither a wall nor, where they wrap around, themselves,
/// however far they go; nothing where walls and periodic axes close around them.
template <int Dim>
std::optional<Vector<Dim>> open_direction(std::vector<Wall<Dim>> const& walls, Domain<Dim> const& domain);

/// Throws UserError where walls contradict each other or what is periodic: one that cuts a periodic axis, or
/// two that bound the same side.
/// @param node the list that `walls` were read from
template <int Dim>
void require_consistent(Node const& node, std::vector<Wall<Dim>> const& walls, Domain<Dim> const& domain);

}  // namespace sphverify
