#pragma once

#include <vector>

#include "formulations/neighbours/neighbours.hpp"
#include "formulations/walls/walls.hpp"

namespace sphverify {

/// Everything that depends on where the particles are: neighbours and wall contacts. `contacts` is empty
/// where a formulation has no wall terms, else it has one entry per wall of `walls`.
template <int Dim>
struct PairGeometry {
  Domain<Dim> domain;
  NeighbourList neighbours;
  std::vector<Wall<Dim>> walls;
  std::vector<WallContacts<Dim>> contacts;

  std::size_t bytes() const {
    std::size_t bytes = neighbours.bytes();
    for (auto const& wall : contacts) bytes += wall.bytes();
    return bytes;
  }
};

}  // namespace sphverify
