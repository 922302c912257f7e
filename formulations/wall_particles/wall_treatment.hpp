// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "formulations/wall_particles/wall_particles.hpp"

namespace sphverify {

/// What a treatment of walls may look at when it places particles behind them.
template <int Dim>
struct WallSurroundings {
  Particles<Dim> const& fluid;
  Domain<Dim> const& domain;               ///< as at the start: moving walls have left its sides
  std::vector<Wall<Dim>> const& walls;     ///< where they stand
  CellGrid<Dim> const& grid;               ///< of the fluid, with the largest support as reach
  double spacing;                          ///< of the fluid's layout [m]

  SmoothingLength lengths() const { return SmoothingLength(fluid); }
  double support() const { return lengths().kernel().support_ratio() * lengths().largest(); }
};

struct WallTreatmentInfo {
  std::string_view id;  ///< as a formulation's `walls` names it
  std::string_view title, source, equation, remarks;
  bool masses_of_sources = false;  ///< what it places has no volume of its own: a density may be a sum over it
};

/// A treatment as a program knows it; wall_treatment_part<Type>() makes it of a header's struct, which has a constexpr `info`
/// and `template <int Dim> static std::vector<PlacedBehind<Dim>> place(WallSurroundings<Dim> const&)`.
struct WallTreatmentPart {
  WallTreatmentInfo const* info;
  std::function<std::vector<PlacedBehind<1>>(WallSurroundings<1> const&)> in_1d;
  std::function<std::vector<PlacedBehind<2>>(WallSurroundings<2> const&)> in_2d;
  std::function<std::vector<PlacedBehind<3>>(WallSurroundings<3> const&)> in_3d;

  template <int Dim>
  std::vector<PlacedBehind<Dim>> place(WallSurroundings<Dim> const& surroundings) const {
    if constexpr (Dim == 1) return in_1d(surroundings);
    if constexpr (Dim == 2) return in_2d(surroundings);
    if constexpr (Dim == 3) return in_3d(surroundings);
  }
};

template <class Treatment>
WallTreatmentPart wall_treatment_part() {
  return {.info = &Treatment::info,
          .in_1d = [](WallSurroundings<1> const& s) { return Treatment::template place<1>(s); },
          .in_2d = [](WallSurroundings<2> const& s) { return Treatment::template place<2>(s); },
          .in_3d = [](WallSurroundings<3> const& s) { return Treatment::template place<3>(s); }};
}

/// Adds a treatment to those of AllWallTreatments, before anything else is asked of them. Throws std::invalid_argument if there
/// is one of that identifier, or it is `on` or `off`.
void add_wall_treatment(WallTreatmentPart const& part);

/// Those of AllWallTreatments in its order, then those that were added.
std::vector<WallTreatmentPart> const& all_wall_treatments();

/// Null if there is none of that identifier.
WallTreatmentPart const* find_wall_treatment(std::string_view id);

/// Throws std::invalid_argument where two parallel walls are closer than the support: particles behind one would be seen
/// through the other.
template <int Dim>
void require_room_between_walls(std::vector<Wall<Dim>> const& walls, double support);

}  // namespace sphverify
