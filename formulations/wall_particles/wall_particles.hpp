// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "formulations/neighbours/neighbours.hpp"
#include "formulations/walls/walls.hpp"

// What stands behind walls in place of a scheme's own wall terms: particles of no fluid, which its pairs see like others.
namespace sphverify {

/// A wall in which values are continued.
template <int Dim>
struct WallMirror {
  std::uint32_t wall = 0;
  Vector<Dim> foot = Vector<Dim>::Zero();  ///< where on its plane what it prescribes is asked for [m]
  double inside = 0.0;  ///< distance from it at which the fluid's values are [m]
  double behind = 0.0;  ///< that of the particle [m]
};

/// A particle behind a wall, as a treatment places it. Its values are means of the fluid's, continued in one wall after the other.
template <int Dim>
struct PlacedBehind {
  Vector<Dim> position;
  std::vector<std::pair<std::uint32_t, double>> sources;  ///< particles of the fluid, and weights that add up to 1
  std::array<WallMirror<Dim>, Dim> mirrors{};
  int mirror_count = 0;
  double volume = 0.0;  ///< times density its mass [m^Dim]; 0: the sources' mass

  void continue_in(WallMirror<Dim> const& mirror) { mirrors[static_cast<std::size_t>(mirror_count++)] = mirror; }
  /// To whose budgets belongs what it exchanges: that behind which it is farthest.
  std::uint32_t booked_to() const {
    std::uint32_t wall = mirrors[0].wall;
    double farthest = mirrors[0].behind;
    for (int k = 1; k < mirror_count; ++k) {
      WallMirror<Dim> const& one = mirrors[static_cast<std::size_t>(k)];
      if (one.behind <= farthest) continue;
      farthest = one.behind;
      wall = one.wall;
    }
    return wall;
  }
};

/// The particles behind one wall, with those of the fluid that see them.
template <int Dim>
struct WallParticles {
  Particles<Dim> particles{0, 1.0};  ///< those of the wall's contacts, in their order; then those behind the wall
  NeighbourList pairs;               ///< per contact those behind the wall within its support
  std::vector<PlacedBehind<Dim>> placed;

  std::size_t bytes() const;
};

/// Puts each where it was placed, behind the wall that it is booked to.
/// @param contacts of all walls
/// @param placed in any order; those that no contact sees are left out
template <int Dim>
std::vector<WallParticles<Dim>> stand_behind_walls(std::vector<PlacedBehind<Dim>> placed,
                                                   std::vector<WallContacts<Dim>> const& contacts, Particles<Dim> const& fluid,
                                                   Domain<Dim> const& domain);

/// Fills fields of the particles behind a wall, and of its contacts.
///
/// Of a mean f of its sources a particle has, for each wall in which it is continued,
///
///   T       2 T_B - T where temperature is prescribed, or a loss of heat that gives it; T - (inside + behind) F_B.n/K where flux
///           is; else T
///   P       2 P_B - P where pressure is prescribed; else P
///   v       2 v_B.n - v.n along the normal where velocity is prescribed: the gas slips; else v
///   F       as -K times the gradient of such a T is: along the wall -2 K grad T_B - F where temperature is prescribed; along the
///           normal 2 F_B.n - F.n where flux is, the other way round where nothing is
///   pass_.. what a reflection makes of a number, a vector or a tensor
///   other   the mean
///
/// @param walls where they stand
template <int Dim>
void fill_wall_particles(WallParticles<Dim>& behind, WallContacts<Dim> const& contacts, std::vector<Wall<Dim>> const& walls,
                         Particles<Dim> const& fluid, FieldSet fields, double time);

/// sum_j m_j W_ij over those behind, added to the fluid's density.  [kg/m^Dim]
template <int Dim>
void add_density_behind(WallParticles<Dim>& behind, WallContacts<Dim> const& contacts, Domain<Dim> const& domain, int threads,
                        std::vector<double>& density);

}  // namespace sphverify
