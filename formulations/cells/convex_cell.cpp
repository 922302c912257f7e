// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/cells/convex_cell.hpp"

#include <algorithm>
#include <stdexcept>

namespace sphverify {

namespace {

/// More planes than this are brought down to those that still have corners before there is room for more.
constexpr std::size_t usual_planes = 64;
/// Memory goes with the square.
constexpr std::size_t most_faces = 2000;

Vector<3> cross(Vector<3> const& a, Vector<3> const& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

void ConvexCell<3>::make_room(std::size_t planes) {
  if (planes <= room_) return;
  std::size_t const old_room = room_;
  room_ = std::max(usual_planes, 2 * planes);
  if (room_ > 2 * most_faces + 2) throw std::length_error("has a Voronoi cell with more than 2000 faces");
  std::vector<Index> const old = std::move(at_edge_);
  at_edge_.assign(room_ * room_, 0);
  for (std::size_t a = 0; a < old_room; ++a)
    std::copy_n(old.begin() + static_cast<std::ptrdiff_t>(a * old_room), old_room,
                at_edge_.begin() + static_cast<std::ptrdiff_t>(a * room_));
}

/// Whether it is there, and has the directed edge.
bool ConvexCell<3>::has_edge(std::size_t corner, Index a, Index b) const {
  if (corner >= corners_.size()) return false;
  Triangle const& planes = corners_[corner];
  for (std::size_t k = 0; k < 3; ++k) {
    if (planes[k] == a && planes[(k + 1) % 3] == b) return true;
  }
  return false;
}

void ConvexCell<3>::add_corner(Vector<3> const& place, Triangle const& planes) {
  auto const n = static_cast<Index>(corners_.size());
  corners_.push_back(planes);
  for (std::size_t k = 0; k < 3; ++k) {
    place_[k].push_back(place[static_cast<Eigen::Index>(k)]);
    at_edge(planes[k], planes[(k + 1) % 3]) = n;
  }
}

/// The last corner takes its number.
void ConvexCell<3>::remove_corner(std::size_t n) {
  std::size_t const last = corners_.size() - 1;
  if (n != last) {
    corners_[n] = corners_[last];
    for (std::size_t k = 0; k < 3; ++k) {
      place_[k][n] = place_[k][last];
      at_edge(corners_[n][k], corners_[n][(k + 1) % 3]) = static_cast<Index>(n);
    }
  }
  corners_.pop_back();
  for (auto& along : place_) along.pop_back();
}

void ConvexCell<3>::reset(Vector<3> const& half, double tolerance) {
  tolerance_ = tolerance;
  is_broken_ = false;
  planes_.clear();
  corners_.clear();
  for (auto& along : place_) along.clear();
  make_room(usual_planes);
  for (int k = 0; k < 3; ++k) {
    for (double const side : {-1.0, 1.0})
      planes_.push_back({side * Vector<3>::Unit(k), half[k], -1 - static_cast<std::int32_t>(planes_.size())});
  }
  for (Index corner = 0; corner < 8; ++corner) {
    Index const x = corner & 1;
    Index const y = (corner >> 1) & 1;
    Index const z = (corner >> 2) & 1;
    Vector<3> const place((2.0 * x - 1.0) * half[0], (2.0 * y - 1.0) * half[1], (2.0 * z - 1.0) * half[2]);
    Index const a = x;
    Index const b = 2 + y;
    Index const c = 4 + z;
    bool const turns_left = (x + y + z) % 2 == 0;
    add_corner(place, turns_left ? Triangle{a, b, c} : Triangle{a, c, b});
  }
}

void ConvexCell<3>::forget_unused_planes() {
  constexpr Index none = 0xFFFF;
  std::vector<Index> number(planes_.size(), none);
  std::vector<CellPlane<3>> used;
  for (Triangle& corner : corners_) {
    for (Index& plane : corner) {
      if (number[plane] == none) {
        number[plane] = static_cast<Index>(used.size());
        used.push_back(planes_[plane]);
      }
      plane = number[plane];
    }
  }
  planes_ = std::move(used);
  for (std::size_t n = 0; n < corners_.size(); ++n) {
    for (std::size_t k = 0; k < 3; ++k) at_edge(corners_[n][k], corners_[n][(k + 1) % 3]) = static_cast<Index>(n);
  }
}

ConvexCell<3>::Index ConvexCell<3>::add_plane(CellPlane<3> const& plane) {
  if (planes_.size() == room_) {
    forget_unused_planes();
    if (2 * planes_.size() > room_) make_room(planes_.size() + 1);
  }
  planes_.push_back(plane);
  return static_cast<Index>(planes_.size() - 1);
}

bool ConvexCell<3>::clip(Vector<3> const& normal, double distance, std::int32_t cut_by) {
  std::size_t const n = corners_.size();
  beyond_.resize(n);
  double const* const x = place_[0].data();
  double const* const y = place_[1].data();
  double const* const z = place_[2].data();
  for (std::size_t v = 0; v < n; ++v) beyond_[v] = normal[0] * x[v] + normal[1] * y[v] + normal[2] * z[v] - distance;
  out_.clear();
  for (std::size_t v = 0; v < n; ++v) {
    if (beyond_[v] > tolerance_) out_.push_back(static_cast<std::uint16_t>(v));
  }
  if (out_.empty()) return false;
  Index const plane = add_plane({normal, distance, cut_by});
  for (std::uint16_t const v : out_) {
    for (std::size_t k = 0; k < 3; ++k) {
      Index const a = corners_[v][k];
      Index const b = corners_[v][(k + 1) % 3];
      Index const across = at_edge(b, a);
      if (across >= n || !has_edge(across, b, a)) {
        is_broken_ = true;
        continue;
      }
      if (beyond_[across] > tolerance_) continue;
      double const inside = std::fmin(0.0, beyond_[across]);
      double const part = inside / (inside - beyond_[v]);
      Vector<3> const from(place_[0][across], place_[1][across], place_[2][across]);
      Vector<3> const to(place_[0][v], place_[1][v], place_[2][v]);
      add_corner(from + part * (to - from), {a, b, plane});
    }
  }
  // From the last on, so that none that goes takes the place of one that is gone.
  for (auto v = out_.rbegin(); v != out_.rend(); ++v) remove_corner(*v);
  return true;
}

double ConvexCell<3>::farthest_squared() const {
  double most = 0.0;
  for (std::size_t v = 0; v < corners_.size(); ++v) {
    double const squared = place_[0][v] * place_[0][v] + place_[1][v] * place_[1][v] + place_[2][v] * place_[2][v];
    most = most < squared ? squared : most;
  }
  return most;
}

/// Half the sum of from x to over the edges around each face; false where Euler's formula does not hold, which says that
/// rounding has told the corners beyond a plane from the others in no consistent way.
bool ConvexCell<3>::measure_faces() {
  if (is_broken_) return false;
  area_.assign(planes_.size(), Vector<3>::Zero());
  has_corner_.assign(planes_.size(), 0);
  for (std::size_t v = 0; v < corners_.size(); ++v) {
    Vector<3> const here(place_[0][v], place_[1][v], place_[2][v]);
    for (std::size_t k = 0; k < 3; ++k) {
      Index const a = corners_[v][k];
      Index const b = corners_[v][(k + 1) % 3];
      has_corner_[a] = 1;
      if (a > b) continue;  // each edge once
      std::size_t const other = at_edge(b, a);
      if (!has_edge(other, b, a)) return false;
      Vector<3> const there(place_[0][other], place_[1][other], place_[2][other]);
      Vector<3> const half = 0.5 * cross(here, there);
      area_[a] += half;
      area_[b] -= half;
    }
  }
  std::size_t faces = 0;
  for (char const one : has_corner_) faces += one ? 1 : 0;
  return corners_.size() + 4 == 2 * faces;
}

/// Expects faces that have been measured. A triangle that rounding turns the other way counts nothing, so that a centroid
/// lies among its face's corners however thin the face.
void ConvexCell<3>::measure_centroids() {
  centroid_.assign(planes_.size(), {Vector<3>::Zero(), Vector<3>::Zero(), 0.0, 0});
  for (std::size_t v = 0; v < corners_.size(); ++v) {
    for (Index const plane : corners_[v]) {
      centroid_[plane].middle += Vector<3>(place_[0][v], place_[1][v], place_[2][v]);
      ++centroid_[plane].corners;
    }
  }
  for (Centroid& one : centroid_) {
    if (one.corners > 0) one.middle /= one.corners;
  }
  for (std::size_t v = 0; v < corners_.size(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) {
      Index const a = corners_[v][k];
      Index const b = corners_[v][(k + 1) % 3];
      std::size_t const other = at_edge(b, a);
      // Around face a from here to there; around b the same edge comes at its other end.
      Centroid& face = centroid_[a];
      Vector<3> const here = Vector<3>(place_[0][v], place_[1][v], place_[2][v]) - face.middle;
      Vector<3> const there = Vector<3>(place_[0][other], place_[1][other], place_[2][other]) - face.middle;
      double const area = std::fmax(0.0, 0.5 * planes_[a].normal.dot(cross(here, there)));
      face.area += area;
      face.moment += area * (here + there);
    }
  }
}

Vector<3> ConvexCell<3>::offset(std::size_t plane) const {
  Centroid const& face = centroid_[plane];
  Vector<3> const& normal = planes_[plane].normal;
  Vector<3> centroid = face.middle;
  if (face.area > 0.0) centroid += face.moment / (3.0 * face.area);
  return centroid - normal.dot(centroid) * normal;
}

}  // namespace sphverify
