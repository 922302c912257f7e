#pragma once

#include <vector>

#include "formulations/support/density.hpp"
#include "formulations/support/neighbours.hpp"
#include "formulations/support/pair_weights.hpp"
#include "formulations/support/walls.hpp"

namespace sphverify {

/// Everything that depends on where the particles are: neighbours, kernel weights, wall contacts. `contacts`
/// is empty where a formulation has no wall terms, else it has one entry per wall of `walls`.
template <int Dim>
struct PairGeometry {
  NeighbourList neighbours;
  PairWeights<Dim> weights;
  std::vector<Wall<Dim>> walls;
  std::vector<WallContacts<Dim>> contacts;

  std::size_t bytes() const {
    std::size_t bytes = neighbours.bytes() + weights.bytes();
    for (auto const& wall : contacts) bytes += wall.bytes();
    return bytes;
  }
};

}  // namespace sphverify
