// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "formulations/basics/vector.hpp"

namespace sphverify {

/// A convex cell about the origin, cut out of a box plane by plane. It serves one cell after the other with the same memory.
///
/// What a plane cuts off by less than `tolerance`, a length, stays: planes that touch a corner, as on a lattice
/// most do, make no face. What remains is still bounded by exact planes, so that its faces close to round-off.
template <int Dim>
class ConvexCell;

/// A face's plane: unit normal, distance from the origin, and by whom it was cut.
template <int Dim>
struct CellPlane {
  Vector<Dim> normal;
  double distance;
  std::int32_t cut_by;
};

template <>
class ConvexCell<1> {
 public:
  /// The box from -half to half; its sides are cut by -1, -2, ... in the order lower and upper of each axis.
  void reset(Vector<1> const& half, double tolerance) {
    tolerance_ = tolerance;
    lower_ = {Vector<1>(-1.0), half[0], -1};
    upper_ = {Vector<1>(1.0), half[0], -2};
  }
  /// Keeps normal . x <= distance. Expects a normal of unit length and a distance that is positive.
  /// @return whether anything was cut off
  bool clip(Vector<1> const& normal, double distance, std::int32_t cut_by) {
    CellPlane<1>& side = normal[0] < 0.0 ? lower_ : upper_;
    if (side.distance - distance <= tolerance_) return false;
    side = {normal, distance, cut_by};
    return true;
  }
  /// The largest squared distance of a corner.
  double farthest_squared() const {
    double const most = lower_.distance < upper_.distance ? upper_.distance : lower_.distance;
    return most * most;
  }
  /// Calls visit(plane, area, offset) for every face: its area [m^(Dim-1)], and how far its centroid is from the foot of the
  /// perpendicular from the origin to its plane [m], zero unless wanted.
  /// @return whether corners, edges and faces are those of one convex body
  template <class Visit>
  bool for_each_face(bool, Visit const& visit) {
    visit(lower_, 1.0, Vector<1>(0.0));
    visit(upper_, 1.0, Vector<1>(0.0));
    return true;
  }

 private:
  CellPlane<1> lower_{}, upper_{};
  double tolerance_ = 0.0;
};

template <>
class ConvexCell<2> {
 public:
  void reset(Vector<2> const& half, double tolerance) {
    tolerance_ = tolerance;
    double const x = half[0];
    double const y = half[1];
    corners_ = {{{-x, -y}, {{0.0, -1.0}, y, -3}},
                {{x, -y}, {{1.0, 0.0}, x, -2}},
                {{x, y}, {{0.0, 1.0}, y, -4}},
                {{-x, y}, {{-1.0, 0.0}, x, -1}}};
  }

  bool clip(Vector<2> const& normal, double distance, std::int32_t cut_by) {
    std::size_t const n = corners_.size();
    beyond_.resize(n);
    bool any = false;
    for (std::size_t k = 0; k < n; ++k) {
      beyond_[k] = normal.dot(corners_[k].place) - distance;
      any = any || beyond_[k] > tolerance_;
    }
    if (!any) return false;
    kept_.clear();
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t const next = k + 1 < n ? k + 1 : 0;
      bool const is_out = beyond_[k] > tolerance_;
      bool const next_is_out = beyond_[next] > tolerance_;
      if (!is_out) kept_.push_back(corners_[k]);
      if (is_out == next_is_out) continue;
      // From the side that stays, whichever way round.
      std::size_t const in = is_out ? next : k;
      std::size_t const out = is_out ? k : next;
      double const inside = std::fmin(0.0, beyond_[in]);
      double const part = inside / (inside - beyond_[out]);
      Vector<2> const place = corners_[in].place + part * (corners_[out].place - corners_[in].place);
      kept_.push_back({place, is_out ? corners_[k].edge : CellPlane<2>{normal, distance, cut_by}});
    }
    corners_.swap(kept_);
    return true;
  }

  double farthest_squared() const {
    double most = 0.0;
    for (Corner const& corner : corners_) most = std::fmax(most, corner.place.squaredNorm());
    return most;
  }

  template <class Visit>
  bool for_each_face(bool wants_offsets, Visit const& visit) {
    std::size_t const n = corners_.size();
    for (std::size_t k = 0; k < n; ++k) {
      Vector<2> const& here = corners_[k].place;
      Vector<2> const& there = corners_[k + 1 < n ? k + 1 : 0].place;
      CellPlane<2> const& edge = corners_[k].edge;
      Vector<2> const direction(-edge.normal[1], edge.normal[0]);
      Vector<2> offset = Vector<2>::Zero();
      if (wants_offsets) offset = 0.5 * direction.dot(here + there) * direction;
      // Seen along the edge as its plane has it: what round-off turns the other way counts less than nothing.
      visit(edge, direction.dot(there - here), offset);
    }
    return n >= 3;
  }

 private:
  struct Corner {
    Vector<2> place;
    CellPlane<2> edge;  ///< from here to the next corner, counter-clockwise
  };

  std::vector<Corner> corners_, kept_;
  std::vector<double> beyond_;
  double tolerance_ = 0.0;
};

/// Three planes meet in every corner; where more do, there are several corners at one place. So a corner is a triangle of the
/// planes' graph, and cutting takes out the triangles beyond the plane and joins the hole's rim to it.
template <>
class ConvexCell<3> {
 public:
  void reset(Vector<3> const& half, double tolerance);
  bool clip(Vector<3> const& normal, double distance, std::int32_t cut_by);
  double farthest_squared() const;
  template <class Visit>
  bool for_each_face(bool wants_offsets, Visit const& visit) {
    if (!measure_faces()) return false;
    if (wants_offsets) measure_centroids();
    for (std::size_t p = 0; p < planes_.size(); ++p) {
      if (has_corner_[p]) visit(planes_[p], area_[p].dot(planes_[p].normal), wants_offsets ? offset(p) : Vector<3>::Zero());
    }
    return true;
  }

 private:
  using Index = std::uint16_t;
  using Triangle = std::array<Index, 3>;  ///< planes, counter-clockwise seen from outside

  Index& at_edge(Index a, Index b) { return at_edge_[a * room_ + b]; }
  bool has_edge(std::size_t corner, Index a, Index b) const;
  void add_corner(Vector<3> const& place, Triangle const& planes);
  void remove_corner(std::size_t n);
  Index add_plane(CellPlane<3> const& plane);
  void forget_unused_planes();
  void make_room(std::size_t planes);
  bool measure_faces();
  void measure_centroids();
  Vector<3> offset(std::size_t plane) const;

  std::vector<CellPlane<3>> planes_;
  std::array<std::vector<double>, 3> place_;  ///< of corners
  std::vector<Triangle> corners_;
  std::vector<Index> at_edge_;  ///< the corner at which the directed edge (a, b) of its triangle lies; room_ x room_
  std::size_t room_ = 0;        ///< for planes
  std::vector<double> beyond_;
  std::vector<std::uint16_t> out_;
  std::vector<Vector<3>> area_;
  std::vector<char> has_corner_;
  /// Per plane what its face's centroid is made of: the mean of its corners, and about it the sums of the areas of the
  /// triangles from there to the edges and of these areas times three centroids.
  struct Centroid {
    Vector<3> middle, moment;
    double area;
    int corners;
  };
  std::vector<Centroid> centroid_;
  bool is_broken_ = false;  ///< rounding has left edges without a corner at their other end
  double tolerance_ = 0.0;
};

}  // namespace sphverify
