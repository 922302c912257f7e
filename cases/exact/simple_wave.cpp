// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/simple_wave.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

namespace {

constexpr double pi = std::numbers::pi;

double speed_before_vacuum(double speed, double rest_sound_speed, double gamma) {
  return require_above("speed", speed, -2.0 * rest_sound_speed / (gamma - 1.0));
}

}  // namespace

SimpleWave::SimpleWave(double speed, double rise_time, double density, double pressure, double gamma)
    : rise_time_(require_positive("rise_time", rise_time)),
      gamma_(require_above("gamma", gamma, 1.0)),
      rest_{require_positive("density", density), 0.0, require_positive("pressure", pressure)},
      rest_sound_speed_(sound_speed(rest_, gamma)),
      speed_(speed_before_vacuum(speed, rest_sound_speed_, gamma)) {}

double SimpleWave::piston_position(double t) const {
  require_not_negative("time", t);
  if (t >= rise_time_) return speed_ * (t - 0.5 * rise_time_);
  return 0.5 * speed_ * (t - rise_time_ / pi * std::sin(pi * t / rise_time_));
}

double SimpleWave::piston_velocity(double t) const {
  require_not_negative("time", t);
  if (t >= rise_time_) return speed_;
  double const root = std::sin(0.5 * pi * t / rise_time_);
  return speed_ * root * root;
}

double SimpleWave::shock_formation_time() const {
  if (speed_ <= 0.0) return std::numeric_limits<double>::infinity();
  double const half = 0.5 * (4.0 * rest_sound_speed_ + (gamma_ - 1.0) * speed_);
  double const product = 2.0 * gamma_ * speed_;
  double const q = product / (half + std::sqrt(half * half + (gamma_ + 1.0) * speed_ * product));
  double const tau = rise_time_ / pi * std::acos(q);
  double const acceleration = 0.5 * pi * speed_ / rise_time_ * std::sqrt(1.0 - q * q);
  double const sound = rest_sound_speed_ + 0.25 * (gamma_ - 1.0) * speed_ * (1.0 - q);
  return tau + 2.0 * sound / ((gamma_ + 1.0) * acceleration);
}

/// Where the characteristic that left the piston at tau is at t.
double SimpleWave::characteristic(double tau, double t) const {
  double const speed = rest_sound_speed_ + 0.5 * (gamma_ + 1.0) * piston_velocity(tau);
  return piston_position(tau) + speed * (t - tau);
}

/// When the characteristic through x left the piston; 0 ahead of the wave. The gas behind the characteristic
/// of the rise's end moves as the piston.
double SimpleWave::departure(double x, double t) const {
  double const last = std::min(t, rise_time_);
  auto ahead = [&](double tau) { return characteristic(tau, t) - x; };
  double const first_ahead = ahead(0.0);
  double const last_ahead = ahead(last);
  if (first_ahead <= 0.0) return 0.0;
  if (last_ahead >= 0.0) return last;
  std::uintmax_t steps = 200;
  auto const [from, to] = boost::math::tools::toms748_solve(
      ahead, 0.0, last, first_ahead, last_ahead, boost::math::tools::eps_tolerance<double>(), steps);
  return 0.5 * (from + to);
}

GasState SimpleWave::at(double x, double t) const {
  require_not_negative("time", t);
  if (double const latest = shock_formation_time(); t > latest) {
    throw BadValue("time", "at most " + brief(latest) + ", when the shock forms", brief(t));
  }
  double const velocity = piston_velocity(departure(x, t));
  double const sound_ratio = 1.0 + 0.5 * (gamma_ - 1.0) * velocity / rest_sound_speed_;
  double const density_ratio = std::pow(sound_ratio, 2.0 / (gamma_ - 1.0));
  return {rest_.density * density_ratio, velocity,
          rest_.pressure * density_ratio * sound_ratio * sound_ratio};
}

double SimpleWave::accuracy() const {
  // To 0.9 of the formation time |dx/dtau| stays above 0.1 of the sound speed, so that rounding x, of up to
  // the way of the wave, moves the velocity by that much.
  double const reach = std::isfinite(shock_formation_time()) ? shock_formation_time() : rise_time_;
  double const steepest = 0.5 * pi * std::abs(speed_) / rise_time_;
  return 8.0 * std::numeric_limits<double>::epsilon() * (std::abs(speed_) + 10.0 * steepest * reach);
}

}  // namespace sphverify::exact
