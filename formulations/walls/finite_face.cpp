#include "formulations/walls/finite_face.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "formulations/basics/expects.hpp"
#include "formulations/basics/gauss.hpp"
#include "formulations/basics/square.hpp"

// Lengths are in units of h from here on; the kernel's shape w and its moments are those of Kernel and
// face-weights.md.
namespace sphverify {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Planes count as at least this far from the point, which spares the limits of solid angles at edges and
/// corners and moves Gamma by no more than that.
constexpr double least_distance = 1e-14;
/// Sine of the angle below which two planes count as parallel.
constexpr double parallel = 1e-12;

/// Half the length of what a circle of radius `reach` leaves of a line at distance rho from its centre.
double half_chord(double reach, double rho) {
  return std::sqrt(std::max(0.0, (reach - rho) * (reach + rho)));
}

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

/// A wall's plane as the point sees it.
template <int Dim>
struct Plane {
  Vector<Dim> normal;
  double distance;
};

/// The walls whose planes lie within reach of x; `index` first where it is one of the walls.
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
        radius_(support == infinity ? infinity : half_chord(support, distance_)) {
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
