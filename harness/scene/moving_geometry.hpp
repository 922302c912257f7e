// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string_view>

#include "formulations/cells/voronoi_weights.hpp"
#include "formulations/density/density.hpp"
#include "formulations/pair_geometry.hpp"
#include "formulations/wall_particles/wall_treatment.hpp"

namespace sphverify {

/// What depends on where the particles of a moving gas are: neighbours, densities that are sums, smoothing
/// lengths that follow the density, wall contacts. Neighbours are found a little beyond the support, by as
/// much as the particles' speed makes cheapest (list_skin.hpp), and are kept until one has moved further than
/// that skin. Voronoi cells are found anew at every place.
template <int Dim>
class MovingGeometry {
 public:
  struct Choice {
    DensityRule density;
    FaceWeight face_weight;
    bool adaptive;           ///< every particle has its own smoothing length, h_i = ratio (m_i/rho_i)^(1/Dim)
    double smoothing_ratio;  ///< h/dx
    int threads;
    PairWeight pair_weight = PairWeight::kernel;
    WallTreatmentPart const* behind_walls = nullptr;  ///< what stands behind them; null: nothing
    double spacing = 0.0;                             ///< of the layout, for those [m]
    bool face_offsets = false;                        ///< whether a form reads where faces have their centroids
    PairSupport support = PairSupport::mean;          ///< which pairs the formulation sees
  };

  MovingGeometry(Domain<Dim> const& domain, Choice const& choice);

  /// Follows the particles, whose `positions` must stay the same object. Writes their densities, unless these
  /// obey the continuity equation, smoothing lengths, and omega where they have it.
  /// @param walls empty without wall terms
  /// @param all_walls of the scene, which bound the gas whether they push it or not
  /// Throws std::invalid_argument when the places make no sense.
  void follow(Particles<Dim>& particles, std::vector<Wall<Dim>> const& walls,
              std::vector<Wall<Dim>> const& all_walls);

  PairGeometry<Dim>& geometry() { return geometry_; }
  PairGeometry<Dim> const& geometry() const { return geometry_; }
  std::map<std::string_view, std::uint64_t> const& passes() const { return passes_; }
  std::size_t bytes() const;

 private:
  bool sums_density() const {
    return choice_.density == DensityRule::summation || choice_.density == DensityRule::normalised;
  }
  bool weighs_by_kernel() const { return choice_.pair_weight == PairWeight::kernel; }
  double skin_used(Particles<Dim> const& particles) const;
  void stand_behind(Particles<Dim>& particles);
  void follow_list(Particles<Dim> const& particles);
  void find_list(Particles<Dim> const& particles, double skin);
  void set_density(Particles<Dim>& particles, CellGrid<Dim> const& grid, std::vector<Wall<Dim>> const& walls);
  void set_omega(Particles<Dim>& particles, CellGrid<Dim> const& grid, std::vector<Wall<Dim>> const& walls);
  void set_smoothing_length(Particles<Dim>& particles);
  void solve_smoothing_length(Particles<Dim>& particles, std::vector<Wall<Dim>> const& walls);

  Choice choice_;
  PairGeometry<Dim> geometry_;
  std::optional<CellGrid<Dim>> grid_;
  VectorField<Dim> found_at_;       ///< places at which the list was found
  std::vector<double> found_with_;  ///< smoothing lengths with which it was; one for all where h is uniform
  double skin_ = 0.0;               ///< of the list, in smoothing lengths
  double used_ = 0.0;               ///< of the skin, at the last place
  std::uint64_t places_ = 0;        ///< to which the particles have moved since it was found
  std::map<std::string_view, std::uint64_t> passes_;
};

extern template class MovingGeometry<1>;
extern template class MovingGeometry<2>;
extern template class MovingGeometry<3>;

}  // namespace sphverify
