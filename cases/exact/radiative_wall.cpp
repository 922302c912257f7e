// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/radiative_wall.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

namespace {

constexpr double half_pi = 0.5 * std::numbers::pi;

double fourth_power(double T) { return (T * T) * (T * T); }

}  // namespace

RadiativeWall::RadiativeWall(double radiation, double start, double environment, double cooling_time,
                             double conductivity, double density)
    : radiation_(require_not_negative("radiation", radiation)),
      start_(require_above("start", start, environment)),
      environment_(require_not_negative("environment", environment)),
      cooling_time_(require_positive("cooling_time", cooling_time)),
      conductivity_(require_positive("conductivity", conductivity)),
      density_(require_positive("density", density)) {}

double RadiativeWall::wall_temperature(double t) const {
  return environment_ + (start_ - environment_) * std::exp(-require_not_negative("time", t) / cooling_time_);
}

double RadiativeWall::radiated(double wall_temperature) const {
  return radiation_ * (fourth_power(wall_temperature) - fourth_power(environment_));
}

double RadiativeWall::steepness(double t) const { return radiated(wall_temperature(t)) / conductivity_; }

double RadiativeWall::temperature(double x, double t) const {
  return wall_temperature(t) + steepness(t) / half_pi * std::cos(half_pi * x);
}

double RadiativeWall::gradient(double x, double t) const { return -steepness(t) * std::sin(half_pi * x); }

double RadiativeWall::source(double x, double t) const {
  double const T = wall_temperature(t);
  double const cooling = -(T - environment_) / cooling_time_;
  double const change = 4.0 * radiation_ * T * T * T * cooling / conductivity_;
  return cooling +
         (change / half_pi + half_pi * conductivity_ / density_ * steepness(t)) * std::cos(half_pi * x);
}

double RadiativeWall::accuracy() const {
  return 8.0 * std::numeric_limits<double>::epsilon() * (start_ + 4.0 * steepness(0.0));
}

}  // namespace sphverify::exact
