// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/walls/face.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace sphverify {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Planes count as at least this far from the point, which spares the limits of solid angles at edges and
/// corners and moves Gamma by no more than that.
constexpr double least_distance = 1e-14;
/// Sine of the angle below which two planes count as parallel.
constexpr double parallel = 1e-12;

}  // namespace

template <int Dim>
std::vector<Plane<Dim>> planes_around(Vector<Dim> const& x, std::vector<Wall<Dim>> const& walls, double h,
                                      std::size_t index, double reach) {
  std::vector<Plane<Dim>> planes;
  auto const add = [&](std::size_t w) {
    double const d = walls[w].distance(x) / h;
    if (d < reach || w == index) planes.push_back({walls[w].outward_normal, std::max(d, least_distance)});
  };
  if (index < walls.size()) add(index);
  for (std::size_t w = 0; w < walls.size(); ++w) {
    if (w != index) add(w);
  }
  return planes;
}

template <int Dim>
void Face<Dim>::find_cuts(std::vector<Plane<Dim>> const& planes, std::size_t index) {
  for (std::size_t j = 0; j < planes.size(); ++j) {
    if (j == index) continue;
    double const cosine = normal_.dot(planes[j].normal);
    double const gap = planes[j].distance - cosine * distance_;  // from the foot point to the other plane
    Vector<Dim> const along = planes[j].normal - cosine * normal_;
    double const sine = along.norm();
    if (sine < parallel) {
      // Opposite walls leave each other whole; of two that face the same way only the nearer has a face.
      if (cosine > 0.0 && (gap < 0.0 || (gap == 0.0 && j < index))) is_empty_ = true;
    } else if (gap <= -sine * radius_) {
      is_empty_ = true;
    } else if (gap < sine * radius_) {
      cuts_.push_back({along / sine, gap / sine});
    }
  }
}

/// Takes from an edge what lies beyond the other lines; false if nothing is left.
template <int Dim>
bool Face<Dim>::clip(Edge<Dim>& edge, std::size_t own) const {
  for (std::size_t k = 0; k < cuts_.size(); ++k) {
    if (k == own) continue;
    double const slope = cuts_[k].normal.dot(edge.direction);
    double const cosine = cuts_[k].normal.dot(edge.line.normal);
    double const room = cuts_[k].distance - cosine * edge.line.distance;
    if (std::abs(slope) < parallel) {
      // Of two walls that cut in the same line one makes the edge.
      bool const same = cosine > 0.0 && std::abs(room) < parallel;
      if (same ? k < own : room < 0.0) return false;
    } else if (slope > 0.0) {
      edge.to = std::min(edge.to, room / slope);
    } else {
      edge.from = std::max(edge.from, room / slope);
    }
  }
  return edge.from < edge.to;
}

template <int Dim>
void Face<Dim>::find_edges() {
  if constexpr (Dim == 2) {
    Edge<2> face{{normal_, 0.0}, {-normal_[1], normal_[0]}, -radius_, radius_};
    is_empty_ = !clip(face, cuts_.size());
    edges_.push_back(face);
  } else if constexpr (Dim == 3) {
    for (std::size_t j = 0; j < cuts_.size(); ++j) {
      double const b =
          radius_ == infinity
              ? infinity
              : std::sqrt(std::max(0.0, (radius_ - cuts_[j].distance) * (radius_ + cuts_[j].distance)));
      Edge<3> edge{cuts_[j], normal_.cross(cuts_[j].normal), -b, b};
      if (clip(edge, j)) edges_.push_back(edge);
    }
  }
}

template <int Dim>
double Face<Dim>::opening() const {
  constexpr double pi = std::numbers::pi;
  if constexpr (Dim == 3) {
    if (cuts_.empty()) return 2.0 * pi;
    // The union of the arcs that lie beyond a line each, as angles from the first line's normal.
    std::vector<std::array<double, 2>> beyond;
    Vector<3> const across = normal_.cross(cuts_[0].normal);
    for (Cut<3> const& cut : cuts_) {
      double const centre = std::atan2(cut.normal.dot(across), cut.normal.dot(cuts_[0].normal));
      double const half = std::acos(std::clamp(cut.distance / radius_, -1.0, 1.0));
      double const from = centre - half;
      double const to = centre + half;
      beyond.push_back({std::max(from, -pi), std::min(to, pi)});
      if (from < -pi) beyond.push_back({from + 2.0 * pi, pi});
      if (to > pi) beyond.push_back({-pi, to - 2.0 * pi});
    }
    std::sort(beyond.begin(), beyond.end());
    double open = 0.0;
    double end = -pi;
    for (auto const& [from, to] : beyond) {
      open += std::max(0.0, from - end);
      end = std::max(end, to);
    }
    return open + (pi - end);
  } else {
    return 0.0;
  }
}

template <int Dim>
std::optional<Vector<Dim>> Face<Dim>::nearest_to_foot() const {
  if (depth() >= 0.0) return Vector<Dim>::Zero();
  std::optional<Vector<Dim>> nearest;
  for (Edge<Dim> const& edge : edges_) {
    Vector<Dim> const point =
        edge.line.distance * edge.line.normal + std::clamp(0.0, edge.from, edge.to) * edge.direction;
    if (!nearest || point.squaredNorm() < nearest->squaredNorm()) nearest = point;
  }
  return nearest;
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                                                      \
  template std::vector<Plane<Dim>> planes_around(Vector<Dim> const&, std::vector<Wall<Dim>> const&, double, std::size_t, \
                                                 double);                                                                \
  template class Face<Dim>;
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
