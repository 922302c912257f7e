// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/cells/voronoi_weights.hpp"
#include "formulations/density/density.hpp"
#include "formulations/particles/particles.hpp"
#include "formulations/viscosity/viscosity.hpp"
#include "formulations/walls/walls.hpp"
#include "reports/json/node.hpp"

namespace sphverify {

/// Particles and walls that a user gives (sphverify-state/1).
template <int Dim>
struct State {
  Particles<Dim> particles;
  Domain<Dim> domain;  ///< the particles' bounding box, or what the state says of periodic axes
  std::vector<Wall<Dim>> walls;
  DensityRule density_rule;  ///< `given` where the state lists densities
  PairWeight pair_weight;
  FaceWeight face_weight;
  Closure closure;
  double time = 0.0;   ///< [s]
  double gamma = 0.0;  ///< ratio of specific heats; 0: not given
  Viscosity viscosity{};
  double rounding = 0.0;  ///< of the numbers, relative to them: of double precision or single
};

/// Complains of a document that is no state, and of its keys.
void require_state_keys(Node const& document);

/// Throws UserError.
template <int Dim>
State<Dim> read_state(Node const& document);

}  // namespace sphverify
