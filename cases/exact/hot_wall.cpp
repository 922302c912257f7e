// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/hot_wall.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

HotWall::HotWall(double wall_temperature, double initial_temperature, double density, double conductivity,
                 double gamma, double start_time, double wall_velocity)
    : wall_temperature_(require_positive("wall", wall_temperature)),
      initial_temperature_(require_positive("initial", initial_temperature)),
      density_(require_positive("density", density)),
      conductivity_(require_positive("conductivity", conductivity)),
      gamma_(require_above("gamma", gamma, 1.0)),
      start_time_(require_positive("start_time", start_time)),
      wall_velocity_(require_finite("piston_velocity", wall_velocity)) {}

double HotWall::elapsed(double t) const { return start_time_ + require_above("time", t, -start_time_); }

/// 2 sqrt(D tau), the mass that eta = 1 stands for.
double HotWall::heated_mass(double t) const {
  return 2.0 * std::sqrt(density_ * conductivity_ / gamma_ * elapsed(t));
}

/// Tw/T0 - 1
double HotWall::expansion() const { return wall_temperature_ / initial_temperature_ - 1.0; }

double HotWall::wall_position(double t) const { return wall_velocity_ * t; }

double HotWall::pressure() const { return (gamma_ - 1.0) * density_ * initial_temperature_; }

double HotWall::conductivity(double temperature) const {
  return conductivity_ * temperature / initial_temperature_;
}

/// Of the particle m from the wall.
double HotWall::distance(double m, double t) const {
  double const mass = heated_mass(t);
  double const eta = m / mass;
  // The integral of erfc from 0 to eta, without the cancellation of 1/sqrt(pi) - ierfc(eta).
  double const heated = eta * std::erfc(eta) - std::expm1(-eta * eta) * std::numbers::inv_sqrtpi;
  return (m + expansion() * mass * heated) / density_;
}

double HotWall::material_position(double m, double t) const { return wall_position(t) + distance(m, t); }

double HotWall::material_velocity(double m, double t) const {
  double const mass = heated_mass(t);
  double const eta = m / mass;
  double const spread = expansion() * 0.5 * mass * std::numbers::inv_sqrtpi / (density_ * elapsed(t));
  return wall_velocity_ - spread * std::expm1(-eta * eta);
}

double HotWall::mass_coordinate(double x, double t) const {
  double const sought = x - wall_position(t);
  if (sought <= 0.0) return 0.0;
  // The density lies between those of the two temperatures.
  double const at_wall = density_ * initial_temperature_ / wall_temperature_;
  auto const [thinnest, thickest] = std::minmax(density_, at_wall);
  constexpr double margin = 1e-9;  // for rounding
  auto beyond = [&](double m) { return distance(m, t) - sought; };
  std::uintmax_t steps = 200;
  auto const [from, to] = boost::math::tools::toms748_solve(
      beyond, (1.0 - margin) * thinnest * sought, (1.0 + margin) * thickest * sought,
      boost::math::tools::eps_tolerance<double>(), steps);
  return 0.5 * (from + to);
}

double HotWall::temperature_at(double eta) const {
  return initial_temperature_ + (wall_temperature_ - initial_temperature_) * std::erfc(eta);
}

double HotWall::temperature(double x, double t) const {
  return temperature_at(mass_coordinate(x, t) / heated_mass(t));
}

GasState HotWall::at(double x, double t) const {
  double const m = mass_coordinate(x, t);
  double const value = temperature_at(m / heated_mass(t));
  return {density_ * initial_temperature_ / value, material_velocity(m, t), pressure()};
}

double HotWall::flux(double x, double t) const {
  double const mass = heated_mass(t);
  double const eta = mass_coordinate(x, t) / mass;
  return density_ * conductivity_ * (wall_temperature_ - initial_temperature_) * 2.0 *
         std::numbers::inv_sqrtpi / mass * std::exp(-eta * eta);
}

double HotWall::acceleration(double x, double t) const {
  double const mass = heated_mass(t);
  double const eta = mass_coordinate(x, t) / mass;
  double const tau = elapsed(t);
  double const square = eta * eta;
  double const scale = expansion() * 0.5 * mass * std::numbers::inv_sqrtpi / (density_ * tau * tau);
  return scale * (0.5 * std::expm1(-square) - square * std::exp(-square));
}

double HotWall::accuracy() const {
  // What rounding a distance of 10 does to the temperature where it varies fastest.
  double const coldest = std::min(wall_temperature_, initial_temperature_);
  double const difference = std::abs(wall_temperature_ - initial_temperature_);
  double const steepest = difference * 2.0 * std::numbers::inv_sqrtpi / heated_mass(0.0) * density_ *
                          initial_temperature_ / coldest;
  return 4.0 * std::numeric_limits<double>::epsilon() *
         (std::max(wall_temperature_, initial_temperature_) + 10.0 * steepest);
}

}  // namespace sphverify::exact
