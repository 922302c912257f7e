#pragma once

#include <cmath>
#include <numbers>
#include <vector>

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

/// The quantities of equations.md for particle i, for a pair and for the foot point of particle i on wall w.
template <int Dim>
class State {
 public:
  explicit State(Scene<Dim> const& scene) : s_(&scene) {}

  std::size_t particles() const { return s_->particles.size(); }
  std::size_t walls() const { return s_->walls.size(); }
  double h() const { return s_->particles.smoothing_length(); }

  Vector<Dim> x(std::size_t i) const { return s_->particles.positions()[i]; }
  double m(std::size_t i) const { return s_->particles.masses()[i]; }
  double rho(std::size_t i) const { return s_->particles.scalar(Field::density)[i]; }
  double P(std::size_t i) const { return s_->particles.scalar(Field::pressure)[i]; }
  double T(std::size_t i) const { return s_->particles.scalar(Field::temperature)[i]; }
  double K(std::size_t i) const { return s_->particles.scalar(Field::conductivity)[i]; }
  Vector<Dim> v(std::size_t i) const { return s_->particles.vector(Field::velocity)[i]; }

  /// grad_i W_ij, zero for j = i.
  Vector<Dim> gradient(std::size_t i, std::size_t j) const {
    Vector<Dim> const r = x(i) - x(j);
    return i == j ? Vector<Dim>::Zero() : Vector<Dim>(slope<Dim>(r.norm(), h()) * r / r.norm());
  }

  Vector<Dim> n(std::size_t w) const { return s_->walls[w].outward_normal; }
  double d(std::size_t i, std::size_t w) const { return n(w).dot(s_->walls[w].point - x(i)); }
  bool touches(std::size_t i, std::size_t w) const { return d(i, w) < 2.0 * h(); }
  Vector<Dim> foot(std::size_t i, std::size_t w) const { return x(i) + d(i, w) * n(w); }

  double A(std::size_t i, std::size_t w) const {
    double const distance = d(i, w);
    if (s_->face_weight == FaceWeight::campbell) {
      double const constant[] = {1.0, 2.0, std::numbers::pi};
      return kernel<Dim>(distance, h()) * constant[Dim - 1] *
             std::pow(4.0 * h() * h() - distance * distance, 0.5 * (Dim - 1));
    }
    std::size_t touched = 0;
    for (std::size_t other = 0; other < walls(); ++other) touched += touches(i, other) ? 1 : 0;
    if (s_->face_weight == FaceWeight::balanced && touched == 1) {
      double sum = 0.0;
      for (std::size_t j = 0; j < particles(); ++j) sum -= m(j) / rho(j) * gradient(i, j).dot(n(w));
      return sum;
    }
    return plane_integral<Dim>(distance, h());
  }
  Vector<Dim> S(std::size_t i, std::size_t w) const { return A(i, w) * n(w); }

  /// rho_B(i)
  double rho(std::size_t i, std::size_t w) const {
    double sum = 0.0;
    for (std::size_t j = 0; j < particles(); ++j)
      sum += 2.0 * m(j) * kernel<Dim>((x(j) - foot(i, w)).norm(), h());
    return sum;
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
    for (std::size_t j = 0; j < particles(); ++j) {
      sum += 2.0 * m(j) / rho(j) * kernel<Dim>((x(j) - foot(i, w)).norm(), h()) * f(j);
    }
    return sum;
  }

  Scene<Dim> const* s_;
};

/// The scenes on which a scheme must agree with its equation: every subset of prescribed values, every face
/// weight, both closures, with and without walls.
template <int Dim, class Compare>
void for_each_scene(Compare const& compare) {
  std::size_t const counts[] = {24, 40, 50};
  for (unsigned number = 0; number < 16; ++number) {
    for (FaceWeight const rule : {FaceWeight::campbell, FaceWeight::exact, FaceWeight::balanced}) {
      for (Closure const closure : {Closure::interpolated, Closure::one_sided}) {
        Scene<Dim> scene =
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
  for_each_scene<Dim>([&](Scene<Dim> const& scene, bool with_walls) {
    auto const expected = equation(State<Dim>(scene), with_walls);
    Rates<Dim> const found = evaluate(scene, id, with_walls);
    if constexpr (std::is_same_v<decltype(expected), std::vector<double> const>) {
      worst = std::max(worst, relative_difference(found.heating, expected));
    } else {
      worst = std::max(worst, relative_difference(found.acceleration, expected));
    }
  });
  return worst;
}

}  // namespace sphverify::tests::dense
