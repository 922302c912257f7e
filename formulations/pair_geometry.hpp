// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "formulations/neighbours/neighbours.hpp"
#include "formulations/wall_particles/wall_particles.hpp"
#include "formulations/walls/walls.hpp"

namespace sphverify {

/// Everything that depends on where the particles are: neighbours and wall contacts. `contacts` is empty
/// where a formulation has no wall terms, else it has one entry per wall of `walls`; so has `behind` where
/// particles stand behind these in place of wall terms.
template <int Dim>
struct PairGeometry {
  Domain<Dim> domain;
  NeighbourList neighbours;
  std::vector<Wall<Dim>> walls;
  std::vector<WallContacts<Dim>> contacts;
  std::vector<WallParticles<Dim>> behind{};
  BoundaryValueSet held{};  ///< what the contacts have already, for all schemes alike: these do not fill it again

  std::size_t bytes() const {
    std::size_t bytes = neighbours.bytes();
    for (auto const& wall : contacts) bytes += wall.bytes();
    for (auto const& wall : behind) bytes += wall.bytes();
    return bytes;
  }
};

}  // namespace sphverify
