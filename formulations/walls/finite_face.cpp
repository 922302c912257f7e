// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/walls/finite_face.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "formulations/basics/expects.hpp"
#include "formulations/basics/gauss.hpp"
#include "formulations/basics/square.hpp"
#include "formulations/walls/face.hpp"

// Lengths are in units of h from here on; the kernel's shape w and its moments are those of Kernel and
// face-weights.md.
namespace sphverify {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Integral of f over part of a line at distance rho from the point, in pieces on which a function of the
/// distance to the point is smooth: cut where it passes a knot of the kernel, and opposite the point.
template <class Function>
double integral_along_line(Function const& f, double rho, double from, double to, Kernel const& kernel) {
  double sum = 0.0;
  double reached = 0.0;
  auto const add = [&](double next) {
    for (auto const& [side_from, side_to] : {std::pair(-next, -reached), std::pair(reached, next)}) {
      double const lower = std::max(from, side_from);
      double const upper = std::min(to, side_to);
      if (lower < upper) sum += gauss(f, lower, upper);
    }
    reached = next;
  };
  for (double const knot : kernel.knots()) {
    if (rho < knot) add(half_chord(knot, rho));
  }
  add(infinity);
  return sum;
}

/// int (V(d) - V(R)) e/(e^2 + t^2) dt along an edge at distance e from the foot point, R^2 = d^2 + e^2 + t^2:
/// what the triangle between foot point and edge adds to the integral of -V'(r)/r over a face at distance d.
/// The pole of e/(e^2 + t^2) is none, since R -> d there.
template <class Potential>
double triangle(Potential const& V, double d, double e, double from, double to, Kernel const& kernel) {
  if (e == 0.0) return 0.0;
  double const at_foot = V(d);
  double const e2 = e * e;
  double const rho2 = d * d + e2;
  return e *
         integral_along_line([&](double t) { return (at_foot - V(std::sqrt(rho2 + t * t))) / (e2 + t * t); },
                             std::sqrt(rho2), from, to, kernel);
}

/// The solid angle of that triangle, from the foot point of its edge to a place t on it.
double solid_angle(double d, double e, double t) {
  double const squared = e * e + t * t;
  double const R = std::sqrt(d * d + squared);
  if (squared == 0.0) return 0.0;
  return std::atan2(t * e * squared / (R + d), e * e * R + t * t * d);
}

/// Integral of w over a face.
double face_integral(Face<2> const& face, Kernel const& kernel) {
  return kernel.line_integral(face.distance(), face.from(), face.to());
}

double face_integral(Face<3> const& face, Kernel const& kernel) {
  auto const moment = [&kernel](double q) { return kernel.first_moment_beyond(q); };
  double const d = face.distance();
  if (face.depth() < -0.5 * face.radius()) {
    // From well outside the face: minus its boundary's integral of the moment, which loses no digits as the
    // face leaves the support.
    double sum = 0.0;
    for (Edge<3> const& edge : face.edges()) {
      double const e = edge.line.distance;
      sum -= e * integral_along_line(
                     [&](double t) {
                       double const squared = e * e + t * t;
                       return moment(std::sqrt(d * d + squared)) / squared;
                     },
                     std::hypot(d, e), edge.from, edge.to, kernel);
    }
    return sum;
  }
  double sum = moment(d) * face.opening();
  for (Edge<3> const& edge : face.edges())
    sum += triangle(moment, d, edge.line.distance, edge.from, edge.to, kernel);
  return sum;
}

/// Area of a face within the support.
double area(Face<2> const& face) { return face.to() - face.from(); }

double area(Face<3> const& face) {
  double twice = face.opening() * square(face.radius());
  for (Edge<3> const& edge : face.edges()) twice += edge.line.distance * (edge.to - edge.from);
  return 0.5 * twice;
}

/// Part of the kernel that a face takes away: the flux through it of a field that has the divergence -W, and
/// one at the point.
double flux(Face<1> const& face, Kernel const& kernel) {
  return 1.0 - kernel.inner_fraction(face.distance(), 1.0);
}

double flux(Face<2> const& face, Kernel const& kernel) {
  return kernel.sigma() * kernel.hidden_by_line(face.distance(), face.from(), face.to());
}

double flux(Face<3> const& face, Kernel const& kernel) {
  double const d = face.distance();
  double const pole = kernel.whole_second_moment();
  auto const potential = [&kernel](double q) { return kernel.smooth_potential(q); };
  double sum = (pole + d * potential(d)) * face.opening();
  for (Edge<3> const& edge : face.edges()) {
    double const e = edge.line.distance;
    sum += pole * (solid_angle(d, e, edge.to) - solid_angle(d, e, edge.from));
    sum += d * triangle(potential, d, e, edge.from, edge.to, kernel);
  }
  return kernel.sigma() * sum;
}

}  // namespace

template <int Dim>
double face_weight(Vector<Dim> const& x, std::vector<Wall<Dim>> const& walls, std::size_t index, double h,
                   FaceWeight rule, Kernel const& kernel) {
  expects(rule != FaceWeight::balanced && index < walls.size());
  double const d = walls[index].distance(x);
  double const support = kernel.support_ratio();
  double const reach = support * h;
  if (d >= reach) return 0.0;
  bool alone = true;
  for (std::size_t w = 0; w < walls.size() && alone; ++w) alone = w == index || walls[w].distance(x) >= reach;
  if (alone) return face_weight<Dim>(d, h, rule, kernel);
  Face<Dim> const face(planes_around(x, walls, h, index, support), 0, support);
  if (face.is_empty()) return 0.0;
  if constexpr (Dim > 1) {
    if (!face.is_cut()) return face_weight<Dim>(d, h, rule, kernel);
    double const value = rule == FaceWeight::exact ? kernel.sigma() * face_integral(face, kernel)
                                                   : kernel.value(face.distance(), 1.0) * area(face);
    return std::max(0.0, value) / h;
  } else {
    return face_weight<Dim>(d, h, rule, kernel);
  }
}

template <int Dim>
double inner_fraction(Vector<Dim> const& x, std::vector<Wall<Dim>> const& walls, double h,
                      Kernel const& kernel) {
  double const support = kernel.support_ratio();
  double inside = 1.0;
  std::size_t near = 0;
  for (Wall<Dim> const& wall : walls) {
    double const d = std::max(0.0, wall.distance(x));  // a foot point may lie outside by round-off
    if (d >= support * h) continue;
    ++near;
    inside -= 1.0 - kernel.inner_fraction(d, h);
  }
  if (near < 2) return inside;
  auto const planes = planes_around(x, walls, h, walls.size(), support);
  double lost = 0.0;
  bool cut = false;
  for (std::size_t f = 0; f < planes.size(); ++f) {
    Face<Dim> const face(planes, f, support);
    cut = cut || face.is_cut() || face.is_empty();
    if (!face.is_empty()) lost += flux(face, kernel);
  }
  return cut ? std::max(0.0, 1.0 - lost) : inside;
}

template <int Dim>
double wall_interpolation_factor(Vector<Dim> const& foot, std::vector<Wall<Dim>> const& walls, double h,
                                 Kernel const& kernel) {
  double const reach = kernel.support_ratio() * h;
  auto const near = std::count_if(walls.begin(), walls.end(),
                                  [&](Wall<Dim> const& wall) { return wall.distance(foot) < reach; });
  return near == 1 ? 2.0 : 1.0 / inner_fraction(foot, walls, h, kernel);
}

template <int Dim>
std::optional<Vector<Dim>> nearest_on_face(Vector<Dim> const& x, std::vector<Wall<Dim>> const& walls,
                                           std::size_t index, double h) {
  Vector<Dim> const foot = walls[index].foot(x);
  bool const inside = std::all_of(walls.begin(), walls.end(), [&](Wall<Dim> const& wall) {
    return &wall == &walls[index] || wall.distance(foot) >= 0.0;
  });
  if (inside) return foot;
  Face<Dim> const face(planes_around(x, walls, h, index, infinity), 0, infinity);
  if (face.is_empty()) return std::nullopt;
  auto const shift = face.nearest_to_foot();
  if (!shift) return std::nullopt;
  return foot + h * *shift;
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                                          \
  template double face_weight(Vector<Dim> const&, std::vector<Wall<Dim>> const&, std::size_t, double,       \
                              FaceWeight, Kernel const&);                                                   \
  template double inner_fraction(Vector<Dim> const&, std::vector<Wall<Dim>> const&, double, Kernel const&); \
  template double wall_interpolation_factor(Vector<Dim> const&, std::vector<Wall<Dim>> const&, double,      \
                                            Kernel const&);                                                 \
  template std::optional<Vector<Dim>> nearest_on_face(Vector<Dim> const&, std::vector<Wall<Dim>> const&,    \
                                                      std::size_t, double);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
