// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "formulations/walls/walls.hpp"

// The face of a wall that meets others, as a point sees it: what their planes leave of its plane. Lengths are in units of h.
// Derived in docs/theory/face-weights.md.
namespace sphverify {

/// Half the length of what a circle of radius `reach` leaves of a line at distance rho from its centre.
inline double half_chord(double reach, double rho) {
  return std::sqrt(std::max(0.0, (reach - rho) * (reach + rho)));
}

/// A wall's plane as the point sees it.
template <int Dim>
struct Plane {
  Vector<Dim> normal;
  double distance;
};

/// The walls whose planes lie within reach of x; `index` first where it is one of the walls.
template <int Dim>
std::vector<Plane<Dim>> planes_around(Vector<Dim> const& x, std::vector<Wall<Dim>> const& walls, double smoothing_length,
                                      std::size_t index, double reach);

/// A line in which another plane cuts a face's: its normal within the face's plane, out of the fluid, and its
/// distance from the foot point, negative where the foot point lies beyond it. In 2D the line is a point.
template <int Dim>
struct Cut {
  Vector<Dim> normal;
  double distance;
};

/// The part of an edge's line within the face, measured from the foot point's foot point on the line.
template <int Dim>
struct Edge {
  Cut<Dim> line;
  Vector<Dim> direction;
  double from, to;
};

/// A face, as much of it as lies within a radius of the foot point (all of it where that is infinite).
template <int Dim>
class Face {
 public:
  /// @param support infinite: the whole face
  Face(std::vector<Plane<Dim>> const& planes, std::size_t index, double support)
      : normal_(planes[index].normal),
        distance_(planes[index].distance),
        radius_(std::isinf(support) ? support : half_chord(support, distance_)) {
    find_cuts(planes, index);
    if (!is_empty_) find_edges();
  }

  double distance() const { return distance_; }
  double radius() const { return radius_; }
  bool is_empty() const { return is_empty_; }
  bool is_cut() const { return !cuts_.empty(); }
  std::vector<Edge<Dim>> const& edges() const { return edges_; }

  /// Where the foot point lies relative to the face: the least distance to an edge's line.
  double depth() const {
    double least = radius_;
    for (Cut<Dim> const& cut : cuts_) least = std::min(least, cut.distance);
    return least;
  }

  /// In 2D: the ends of the face on the line with the direction that `along` gives.
  double from() const { return edges_.front().from; }
  double to() const { return edges_.front().to; }

  /// In 3D: the angle under which the foot point sees the arcs that bound the face at its radius.
  double opening() const;

  /// Vector from the foot point to the point of the face nearest to it. Expects a face that is not empty.
  std::optional<Vector<Dim>> nearest_to_foot() const;

 private:
  void find_cuts(std::vector<Plane<Dim>> const& planes, std::size_t index);
  void find_edges();
  bool clip(Edge<Dim>& edge, std::size_t own) const;

  Vector<Dim> normal_;
  double distance_;
  double radius_;
  bool is_empty_ = false;
  std::vector<Cut<Dim>> cuts_;
  std::vector<Edge<Dim>> edges_;  ///< in 2D one, the face itself
};

}  // namespace sphverify
