// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/evaluate/enclosure.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

namespace sphverify {

namespace {

constexpr double round_off = 1e-6;  // of components of unit vectors, which may come from single precision

/// Refuses a list with what is in it.
[[noreturn]] void refuse(Node const& node, std::string const& expected) {
  throw UserError(node.file(), node.key(), node.json().dump(), expected);
}

/// Vectors that are orthogonal to all but one dimension's worth of `vectors`, not of unit length, some of
/// them zero.
std::vector<Vector<1>> orthogonal(std::vector<Vector<1>> const&) { return {Vector<1>(1.0)}; }
std::vector<Vector<2>> orthogonal(std::vector<Vector<2>> const& vectors) {
  std::vector<Vector<2>> all;
  for (Vector<2> const& v : vectors) all.emplace_back(-v[1], v[0]);
  return all;
}
std::vector<Vector<3>> orthogonal(std::vector<Vector<3>> const& vectors) {
  std::vector<Vector<3>> all;
  for (std::size_t a = 0; a < vectors.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) all.push_back(vectors[a].cross(vectors[b]));
  }
  return all;
}

}  // namespace

/// The directions that lead away from no wall are a cone, n . u <= 0 for every wall, and along periodic axes
/// u = 0. If it holds more than 0 it has an edge or a line, on which as many of these (or of the coordinates'
/// own planes) are equalities as leave one direction.
template <int Dim>
std::optional<Vector<Dim>> open_direction(std::vector<Wall<Dim>> const& walls, Domain<Dim> const& domain) {
  std::vector<Vector<Dim>> normals;
  for (Wall<Dim> const& wall : walls) normals.push_back(wall.outward_normal);
  for (int k = 0; k < Dim; ++k) normals.push_back(Vector<Dim>::Unit(k));
  auto const is_open = [&](Vector<Dim> const& u) {
    for (int k = 0; k < Dim; ++k) {
      if (domain.periodic[k] && std::abs(u[k]) > round_off) return false;
    }
    for (Wall<Dim> const& wall : walls) {
      if (wall.outward_normal.dot(u) > round_off) return false;
    }
    return true;
  };
  for (Vector<Dim> const& along : orthogonal(normals)) {
    if (along.norm() < round_off) continue;
    Vector<Dim> const u = along.normalized();
    // Adding zero takes the sign from zeros.
    if (is_open(u)) return u + Vector<Dim>::Zero();
    if (is_open(-u)) return -u + Vector<Dim>::Zero();
  }
  return std::nullopt;
}

template <int Dim>
void require_consistent(Node const& node, std::vector<Wall<Dim>> const& walls, Domain<Dim> const& domain) {
  auto const elements = node.elements();
  for (std::size_t w = 0; w < walls.size(); ++w) {
    Vector<Dim> const& normal = walls[w].outward_normal;
    for (int k = 0; k < Dim; ++k) {
      if (domain.periodic[k] && std::abs(normal[k]) > round_off) {
        refuse(elements[w].at("outward_normal"),
               fmt::format("no component along axis {}, which is periodic", k));
      }
    }
    for (std::size_t v = 0; v < w; ++v) {
      if ((normal - walls[v].outward_normal).norm() < round_off) {
        refuse(elements[w].at("outward_normal"), fmt::format("another side than that of walls[{}]", v));
      }
    }
  }
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                                       \
  template std::optional<Vector<Dim>> open_direction(std::vector<Wall<Dim>> const&, Domain<Dim> const&); \
  template void require_consistent(Node const&, std::vector<Wall<Dim>> const&, Domain<Dim> const&);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
