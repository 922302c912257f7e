// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "formulations/walls/finite_face.hpp"
#include "tests/support/quadrature.hpp"
#include "tests/support/random_particles.hpp"

// equations.md written down a second time, with a double loop over all particles, Eq. 24's own form of the
// spline and quadrature in place of closed forms. It shares the storage of the particles with the product and
// nothing else.
namespace sphverify::tests::dense {

/// Bound on the relative deviation from a dense sum. Where a foot point has one neighbour, close to the edge
/// of the support, A_i/rho_B is a quotient of two small numbers that 2 - r/h has cost up to six digits.
inline constexpr double round_off = 1e-9;

template <int Dim>
constexpr double normalisation = Dim == 1   ? 1.0
                                 : Dim == 2 ? 15.0 / (7.0 * std::numbers::pi)
                                            : 1.5 / std::numbers::pi;

/// W(r, h) in the form of Eq. 24.
template <int Dim>
double kernel(double r, double h) {
  double const u = r / h;
  double const shape =
      u >= 2.0 ? 0.0 : (u < 1.0 ? 2.0 / 3.0 - u * u + 0.5 * u * u * u : std::pow(2.0 - u, 3) / 6.0);
  return normalisation<Dim> * shape / std::pow(h, Dim);
}

/// dW/dr of Eq. 24.
template <int Dim>
double slope(double r, double h) {
  double const u = r / h;
  double const shape = u >= 2.0 ? 0.0 : (u < 1.0 ? -2.0 * u + 1.5 * u * u : -0.5 * (2.0 - u) * (2.0 - u));
  return normalisation<Dim> * shape / std::pow(h, Dim + 1);
}

/// Integral of W over a plane at distance d, along the plane.
template <int Dim>
double plane_integral(double d, double h) {
  if (d >= 2.0 * h) return 0.0;
  if (Dim == 1) return kernel<Dim>(d, h);
  auto const integrand = [d, h](double s) {
    return (Dim == 2 ? 2.0 : 2.0 * std::numbers::pi * s) * kernel<Dim>(std::hypot(d, s), h);
  };
  double const edge = std::sqrt((2.0 * h - d) * (2.0 * h + d));
  double const knot = d < h ? std::sqrt((h - d) * (h + d)) : 0.0;
  return quadrature(integrand, 0.0, knot) + quadrature(integrand, knot, edge);
}

/// Part of the kernel on this side of a plane at distance d: 1 less the integral over the shells beyond it.
template <int Dim>
double inner_fraction(double d, double h) {
  auto const beyond = [d, h](double r) {
    double const measure = Dim == 1   ? 1.0
                           : Dim == 2 ? 2.0 * r * std::acos(std::min(1.0, d / r))
                                      : 2.0 * std::numbers::pi * r * (r - d);
    return measure * kernel<Dim>(r, h);
  };
  return 1.0 - quadrature(beyond, std::min(d, h), h) - quadrature(beyond, std::max(d, h), 2.0 * h);
}

/// Integral of f(r) over the face of a plane at distance d that a second one, whose line is at distance e
/// from the foot point, cuts: in rings around the foot point, of which an arc lies beyond the line.
template <int Dim, class Function>
double cut_plane_integral(double d, double e, double h, Function const& f) {
  if (d >= 2.0 * h) return 0.0;
  double const edge = std::sqrt((2.0 * h - d) * (2.0 * h + d));
  double const knot = d < h ? std::sqrt((h - d) * (h + d)) : 0.0;
  auto const ring = [&](double s) {
    if (Dim == 2) return ((e > -s ? 1.0 : 0.0) + (e >= s ? 1.0 : 0.0)) * f(std::hypot(d, s));
    double const closed = e >= s ? 0.0 : (e <= -s ? std::numbers::pi : std::acos(e / s));
    return 2.0 * (std::numbers::pi - closed) * s * f(std::hypot(d, s));
  };
  std::array<double, 4> ends{0.0, knot, std::min(edge, std::abs(e)), edge};
  std::sort(ends.begin(), ends.end());
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    // With s = a + (b - a) u^2 (3 - 2u) the root at an arc's start does no harm.
    double const a = ends[k], b = ends[k + 1];
    sum += quadrature(
        [&](double u) { return 6.0 * u * (1.0 - u) * (b - a) * ring(a + (b - a) * u * u * (3.0 - 2.0 * u)); },
        0.0, 1.0, 1e-11);
  }
  return sum;
}

/// Part of the kernel around a point of one plane that lies inside it and inside another at distance d, whose
/// outward normal has a cosine with the first's: by rays, in cones around the other's normal.
template <int Dim>
double wedge_fraction(double d, double cosine, double h) {
  double const sine = std::sqrt(1.0 - cosine * cosine);
  auto const along_ray = [h](double R) {
    auto const shell = [h](double r) { return std::pow(r, Dim - 1) * kernel<Dim>(r, h); };
    // Polynomials of degree D + 2 at most: Gauss's rule is exact, and asked for often.
    using Gauss = boost::math::quadrature::gauss<double, 7>;
    double const inner = Gauss::integrate(shell, 0.0, std::min(R, h));
    return R > h ? inner + Gauss::integrate(shell, h, std::min(R, 2.0 * h)) : inner;
  };
  double const whole = along_ray(2.0 * h);
  // theta from the other's normal; in 3D the part of its cone that lies inside the first plane.
  auto const cone = [&](double theta) {
    double const c = std::cos(theta), s = std::sin(theta);
    double open;
    if (Dim == 2) {
      open = (c * cosine + s * sine < 0.0 ? 1.0 : 0.0) + (c * cosine - s * sine < 0.0 ? 1.0 : 0.0);
    } else {
      open = 2.0 * s * std::acos(std::clamp(c * cosine / std::max(1e-300, s * sine), -1.0, 1.0));
    }
    return open == 0.0 ? 0.0 : open * (2.0 * h * c <= d ? whole : along_ray(d / c));
  };
  double const tilt = std::acos(std::abs(cosine));
  std::vector<double> ends{0.0, 0.5 * std::numbers::pi - tilt, 0.5 * std::numbers::pi,
                           0.5 * std::numbers::pi + tilt, std::numbers::pi};
  for (double const r : {h, 2.0 * h}) {
    if (d < r) ends.push_back(std::acos(d / r));
  }
  std::sort(ends.begin(), ends.end());
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    double const a = ends[k], b = ends[k + 1];
    sum += quadrature(
        [&](double u) { return 6.0 * u * (1.0 - u) * (b - a) * cone(a + (b - a) * u * u * (3.0 - 2.0 * u)); },
        0.0, 1.0, 1e-11);
  }
  return sum;
}

/// The quantities of equations.md for particle i, for a pair and for the foot point of particle i on wall w.
template <int Dim>
class State {
 public:
  explicit State(RandomScene<Dim> const& scene) : s_(&scene) {}

  std::size_t particles() const { return s_->particles.size(); }
  std::size_t walls() const { return s_->walls.size(); }
  double h() const { return s_->particles.smoothing_length(); }

  Vector<Dim> x(std::size_t i) const { return s_->particles.positions()[i]; }
  double m(std::size_t i) const { return s_->particles.masses()[i]; }
  double rho(std::size_t i) const { return s_->particles.scalar(Field::density)[i]; }
  double P(std::size_t i) const { return s_->particles.scalar(Field::pressure)[i]; }
  double Omega(std::size_t i) const { return s_->particles.scalar(Field::omega)[i]; }
  double T(std::size_t i) const { return s_->particles.scalar(Field::temperature)[i]; }
  double K(std::size_t i) const { return s_->particles.scalar(Field::conductivity)[i]; }
  Vector<Dim> v(std::size_t i) const { return s_->particles.vector(Field::velocity)[i]; }

  /// grad_i W_ij, zero for j = i.
  Vector<Dim> gradient(std::size_t i, std::size_t j) const {
    Vector<Dim> const r = x(i) - x(j);
    return i == j ? Vector<Dim>::Zero() : Vector<Dim>(slope<Dim>(r.norm(), h()) * r / r.norm());
  }

  /// W_ij, with W_ii.
  double W(std::size_t i, std::size_t j) const { return kernel<Dim>((x(i) - x(j)).norm(), h()); }
  /// Part of the kernel inside all walls. Where two cut it, as the product has it, which its own tests hold to rays.
  double Gamma(std::size_t i) const {
    double part = 1.0;
    std::size_t touched = 0;
    for (std::size_t w = 0; w < walls(); ++w) {
      if (!is_near(i, w)) continue;
      ++touched;
      part = inner_fraction<Dim>(d(i, w), h());
    }
    return touched < 2 ? part : sphverify::inner_fraction(x(i), s_->walls, h(), s_->particles.kernel());
  }

  Vector<Dim> n(std::size_t w) const { return s_->walls[w].outward_normal; }
  double d(std::size_t i, std::size_t w) const { return n(w).dot(s_->walls[w].point - x(i)); }
  bool is_near(std::size_t i, std::size_t w) const { return d(i, w) < 2.0 * h(); }
  bool touches(std::size_t i, std::size_t w) const {
    return is_near(i, w) && (foot(i, w) - x(i)).norm() < 2.0 * h();
  }
  /// Nearest point of the face: the plane's own foot point, or where beyond the other wall, on their edge.
  Vector<Dim> foot(std::size_t i, std::size_t w) const {
    Vector<Dim> const own = x(i) + d(i, w) * n(w);
    auto const [distance, along] = cut(own, w);
    return distance < 0.0 ? Vector<Dim>(own + distance * along) : own;
  }

  double A(std::size_t i, std::size_t w) const {
    double const distance = d(i, w);
    double const e = cut(x(i) + distance * n(w), w).first;
    bool const is_cut = Dim > 1 && e < std::sqrt(std::max(0.0, 4.0 * h() * h() - distance * distance));
    if (s_->face_weight == FaceWeight::campbell) {
      double const W = kernel<Dim>(distance, h());
      if (is_cut) return W * cut_plane_integral<Dim>(distance, e, h(), [](double) { return 1.0; });
      double const constant[] = {1.0, 2.0, std::numbers::pi};
      return W * constant[Dim - 1] * std::pow(4.0 * h() * h() - distance * distance, 0.5 * (Dim - 1));
    }
    std::size_t touched = 0;
    for (std::size_t other = 0; other < walls(); ++other) touched += is_near(i, other) ? 1 : 0;
    if (s_->face_weight == FaceWeight::balanced && touched == 1) {
      double sum = 0.0;
      for (std::size_t j = 0; j < particles(); ++j) sum -= m(j) / rho(j) * gradient(i, j).dot(n(w));
      return sum;
    }
    if (is_cut) {
      return cut_plane_integral<Dim>(distance, e, h(), [this](double r) { return kernel<Dim>(r, h()); });
    }
    return plane_integral<Dim>(distance, h());
  }
  Vector<Dim> S(std::size_t i, std::size_t w) const { return A(i, w) * n(w); }

  /// rho_B(i)
  double rho(std::size_t i, std::size_t w) const {
    double sum = 0.0;
    Vector<Dim> const at = foot(i, w);
    for (std::size_t j = 0; j < particles(); ++j) sum += m(j) * kernel<Dim>((x(j) - at).norm(), h());
    return factor(i, w) * sum;
  }
  double P(std::size_t i, std::size_t w) const {
    return s_->walls[w].pressure ? s_->walls[w].pressure(foot(i, w), s_->time)
                                 : interpolated<double>(
                                       i, w, [&](std::size_t j) { return P(j); }, 0.0);
  }
  Vector<Dim> v(std::size_t i, std::size_t w) const {
    return s_->walls[w].velocity ? s_->walls[w].velocity(foot(i, w), s_->time)
                                 : interpolated<Vector<Dim>>(
                                       i, w, [&](std::size_t j) { return v(j); }, Vector<Dim>::Zero());
  }
  bool flux_only(std::size_t w) const { return s_->walls[w].flux && !s_->walls[w].temperature; }
  double T(std::size_t i, std::size_t w) const {
    Wall<Dim> const& wall = s_->walls[w];
    if (wall.temperature) return wall.temperature(foot(i, w), s_->time);
    if (wall.flux && s_->closure == Closure::one_sided) {
      return T(i) - wall.flux(foot(i, w), s_->time).dot(n(w)) * d(i, w) / K(i);
    }
    return interpolated<double>(
        i, w, [&](std::size_t j) { return T(j); }, 0.0);
  }
  double K(std::size_t i, std::size_t w) const {
    return s_->walls[w].conductivity ? s_->walls[w].conductivity(foot(i, w), s_->time)
                                     : interpolated<double>(
                                           i, w, [&](std::size_t j) { return K(j); }, 0.0);
  }
  /// F_B(i), given the particles' fluxes.
  Vector<Dim> F(std::size_t i, std::size_t w, std::vector<Vector<Dim>> const& flux) const {
    Wall<Dim> const& wall = s_->walls[w];
    if (wall.flux) return wall.flux(foot(i, w), s_->time);
    if (wall.temperature && s_->closure == Closure::one_sided) {
      return -K(i, w) * (T(i, w) - T(i)) / d(i, w) * n(w);
    }
    return interpolated<Vector<Dim>>(
        i, w, [&](std::size_t j) { return flux[j]; }, Vector<Dim>::Zero());
  }

 private:
  template <class Value, class Function>
  Value interpolated(std::size_t i, std::size_t w, Function const& f, Value sum) const {
    double const scale = factor(i, w);
    Vector<Dim> const at = foot(i, w);
    for (std::size_t j = 0; j < particles(); ++j) {
      sum += scale * m(j) / rho(j) * kernel<Dim>((x(j) - at).norm(), h()) * f(j);
    }
    return sum;
  }

  /// Where the other of at most two walls cuts wall w's plane: distance from a point of the plane, and the
  /// line's normal.
  std::pair<double, Vector<Dim>> cut(Vector<Dim> const& point, std::size_t w) const {
    if (walls() == 2) {
      Vector<Dim> const other = n(1 - w);
      Vector<Dim> const along = other - other.dot(n(w)) * n(w);
      if (along.norm() > 1e-10)
        return {(s_->walls[1 - w].point - point).dot(other) / along.norm(), along.normalized()};
    }
    return {std::numeric_limits<double>::infinity(), Vector<Dim>::Zero()};
  }

  /// 1/Gamma at the foot point; quadratures are costly, so that they are kept.
  double factor(std::size_t i, std::size_t w) const {
    if (walls() < 2) return 2.0;
    double const beyond = (s_->walls[1 - w].point - foot(i, w)).dot(n(1 - w));
    if (beyond >= 2.0 * h()) return 2.0;
    auto const [known, is_new] = factors_.try_emplace({i, w}, 0.0);
    double const cosine = n(w).dot(n(1 - w));
    if (is_new) {
      known->second = 1.0 / (cosine < -1.0 + 1e-12 ? inner_fraction<Dim>(beyond, h()) - 0.5
                                                   : wedge_fraction<Dim>(std::max(0.0, beyond), cosine, h()));
    }
    return known->second;
  }

  mutable std::map<std::pair<std::size_t, std::size_t>, double> factors_;

  RandomScene<Dim> const* s_;
};

/// Brookshaw's difference form (Eq. 63) with some mean of two conductivities; at a wall of prescribed flux only -2 F_B.S_i/rho_i.
template <int Dim, class Mean>
std::vector<double> difference_form(State<Dim> const& s, bool with_walls, Mean const& mean) {
  std::vector<double> rate(s.particles(), 0.0);
  for (std::size_t i = 0; i < s.particles(); ++i) {
    for (std::size_t j = 0; j < s.particles(); ++j) {
      if (j == i) continue;
      Vector<Dim> const r = s.x(i) - s.x(j);
      rate[i] += 2.0 * s.m(j) * mean(s.K(i), s.K(j)) / (s.rho(i) * s.rho(j)) * (s.T(i) - s.T(j)) *
                 r.dot(s.gradient(i, j)) / r.squaredNorm();
    }
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (!s.touches(i, w)) continue;
      if (s.flux_only(w)) {
        rate[i] -= 2.0 * s.F(i, w, {}).dot(s.S(i, w)) / s.rho(i);
      } else {
        rate[i] += 2.0 * mean(s.K(i), s.K(i, w)) / s.rho(i) * (s.T(i, w) - s.T(i)) / s.d(i, w) * s.A(i, w);
      }
    }
  }
  return rate;
}

/// The mean of Eq. 63.
inline double arithmetic(double a, double b) { return 0.5 * (a + b); }

/// The scenes on which a scheme must agree with its equation: every subset of prescribed values, every face
/// weight, both closures, with and without walls.
template <int Dim, class Compare>
void for_each_scene(Compare const& compare) {
  std::size_t const counts[] = {24, 40, 50};
  for (unsigned number = 0; number < 16; ++number) {
    for (FaceWeight const rule : {FaceWeight::campbell, FaceWeight::exact, FaceWeight::balanced}) {
      for (Closure const closure : {Closure::interpolated, Closure::one_sided}) {
        RandomScene<Dim> scene =
            random_scene<Dim>(100 + number, counts[Dim - 1], subset(number), subset(5 * number + 3));
        scene.face_weight = rule;
        scene.closure = closure;
        compare(scene, true);
      }
    }
    compare(random_scene<Dim>(200 + number, counts[Dim - 1], subset(number), subset(5 * number + 3)), false);
  }
}

/// Largest deviation of a scheme from rate(state, i, with_walls), over all scenes, relative to the largest
/// rate.
template <int Dim, class Equation>
double deviation(std::string_view id, Equation const& equation) {
  double worst = 0.0;
  for_each_scene<Dim>([&](RandomScene<Dim> const& narrow, bool with_walls) {
    bool const is_wide = find_scheme(id)->needs_partners;
    RandomScene<Dim> const scene = is_wide ? widened(narrow) : narrow;
    auto const expected = equation(State<Dim>(scene), with_walls);
    Rates<Dim> const found = evaluate(scene, id, geometry_of(scene, with_walls));
    if constexpr (std::is_same_v<decltype(expected), std::vector<double> const>) {
      worst = std::max(worst, relative_difference(found.heating, expected));
    } else {
      worst = std::max(worst, relative_difference(found.acceleration, expected));
    }
  });
  return worst;
}

}  // namespace sphverify::tests::dense
