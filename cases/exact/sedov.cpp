// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/sedov.hpp"

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

namespace {

int plane_axis_or_point(int dimension) {
  if (require_positive("dimension", dimension) <= 3) return dimension;
  throw BadValue("dimension", "1, 2 or 3", std::to_string(dimension));
}

/// A at the shock, times gamma + 1. It is positive where V rises from the centre to the shock.
double a_at_shock(int d, double gamma) { return (2 - d) * gamma + (3 * d - 2); }

double fills_the_centre(int d, double gamma) {
  require_above("gamma", gamma, 1.0);
  if (a_at_shock(d, gamma) > 0.0) return gamma;
  throw BadValue("gamma", "below 7 for gas to reach the centre in 3D", brief(gamma));
}

}  // namespace

Sedov::Sedov(int dimension, double gamma, double density, double energy)
    : dimension_(plane_axis_or_point(dimension)),
      gamma_(fills_the_centre(dimension, gamma)),
      density_(require_positive("density", density)),
      energy_(require_positive("energy", energy)),
      delta_(2.0 / (dimension + 2.0)),
      s_(2.0 + dimension * (gamma - 1.0)) {
  double const d = dimension;
  double const q = 2.0 * gamma + d - 2.0;
  b_ = (gamma - 1.0) / q;
  a_ = delta_ - (gamma + 1.0) / s_ - b_;
  k_ = (d - 2.0) * ((d - 2.0) * gamma - 3.0 * d + 2.0) / (s_ * q);
  alpha_ = energy_integral();
}

/// All is written in B^ = (gamma V - 1)(gamma + 1)/(gamma - 1), from 0 at the centre to 1 at the shock, so
/// that nothing cancels; its logarithm is the argument, since B^ underflows before xi does.
Sedov::Shape Sedov::shape(double log_b) const {
  double const d = dimension_;
  double const gamma = gamma_;
  double const missing = -std::expm1(log_b);  // 1 - B^
  double const a_shock = a_at_shock(dimension_, gamma);
  double const log_V = std::log1p(-0.5 * (gamma - 1.0) / gamma * missing);
  double const log_A = std::log1p(s_ * (gamma - 1.0) / (gamma * a_shock) * missing);
  double const log_C = std::log1p(missing / gamma);
  // A^/C^ = 1 + (2 - gamma) slope
  double const slope = -d * (gamma + 1.0) * missing / (a_shock * (gamma + missing));
  double const excess = 2.0 - gamma;
  double const L = excess == 0.0 ? slope : std::log1p(excess * slope) / excess;
  double const log_common = -k_ * log_C - (d + 2.0) * a_ * L;
  return {-delta_ * log_V + a_ * log_A + b_ * log_b,
          (1.0 + (gamma - 1.0) / (gamma + 1.0) * std::exp(log_b)) / gamma,
          std::exp(d / (2.0 * gamma + d - 2.0) * log_b + log_common),
          std::exp((2.0 - 2.0 * delta_) * log_V + 2.0 * a_ * log_A + log_C + log_common)};
}

/// ln B^ where ln xi < 0 has this value. Both rise together, and ln xi - b ln B^ is bounded.
double Sedov::log_b_at(double log_xi) const {
  auto const beyond = [&](double log_b) { return shape(log_b).log_xi - log_xi; };
  double low = log_xi / b_ - 1.0;
  while (beyond(low) > 0.0) low *= 2.0;
  std::uintmax_t steps = 200;
  auto const [from, to] =
      boost::math::tools::toms748_solve(beyond, low, 0.0, boost::math::tools::eps_tolerance<double>(), steps);
  return 0.5 * (from + to);
}

/// alpha, by an integral over y = B^^(d b), which goes as the volume near the centre.
double Sedov::energy_integral() const {
  double const d = dimension_;
  double const gamma = gamma_;
  auto const integrand = [&](double y) {
    double const log_y = std::log(y);
    Shape const here = shape(log_y / (d * b_));
    double const V = here.V;
    double const kinetic =
        0.5 * (gamma + 1.0) / (gamma - 1.0) * here.density * V * V * std::exp(2.0 * here.log_xi);
    double const internal = 2.0 / (gamma * gamma - 1.0) * here.pressure;
    // d(ln xi)/d(ln B^)
    double const slope =
        (gamma * (gamma + 1.0) * V * V - 2.0 * (gamma + 1.0) * V + 2.0) / (gamma * V * (d + 2.0 - s_ * V));
    return (kinetic + internal) * std::exp(d * here.log_xi - log_y) * slope / (d * b_);
  };
  constexpr double whole_angle[] = {2.0, 2.0 * std::numbers::pi, 4.0 * std::numbers::pi};
  boost::math::quadrature::tanh_sinh<double> quadrature;
  return delta_ * delta_ * whole_angle[dimension_ - 1] * quadrature.integrate(integrand, 0.0, 1.0, 1e-14);
}

GasState Sedov::at(double r, double t) const {
  require_not_negative("radius", r);
  double const radius = shock_radius(t);
  if (r >= radius) return {density_, 0.0, 0.0};
  double const speed = shock_speed(t);
  double const highest = 2.0 * density_ * speed * speed / (gamma_ + 1.0);
  Shape const here =
      shape(r > 0.0 ? log_b_at(std::log(r / radius)) : -std::numeric_limits<double>::infinity());
  return {(gamma_ + 1.0) / (gamma_ - 1.0) * density_ * here.density, r / radius * speed * here.V,
          highest * here.pressure};
}

double Sedov::shock_radius(double t) const {
  double const time = require_not_negative("time", t);
  return std::pow(energy_ / (alpha_ * density_) * time * time, 1.0 / (dimension_ + 2.0));
}

double Sedov::shock_speed(double t) const {
  return 2.0 / (dimension_ + 2.0) * shock_radius(require_positive("time", t)) / t;
}

double Sedov::shock_time(double radius) const {
  return std::sqrt(alpha_ * density_ / energy_ *
                   std::pow(require_not_negative("radius", radius), dimension_ + 2));
}

double Sedov::energy_constant() const { return alpha_; }

double Sedov::accuracy() const {
  // The density's highest power of xi, d/(gamma-1), takes its digits.
  return 32.0 * std::numeric_limits<double>::epsilon() * dimension_ * gamma_ / (gamma_ - 1.0);
}

}  // namespace sphverify::exact
