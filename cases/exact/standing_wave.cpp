// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/standing_wave.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

namespace {

double modest(double amplitude, double gamma) {
  double const limit = 1.0 / (gamma + 1.0);
  if (require_positive("amplitude", amplitude) < limit) return amplitude;
  throw BadValue("amplitude", "below " + brief(limit), brief(amplitude));
}

}  // namespace

StandingWave::StandingWave(double amplitude, int mode, double density, double pressure, double gamma)
    : wave_number_(require_positive("mode", mode) * std::numbers::pi),
      gamma_(require_above("gamma", gamma, 1.0)),
      amplitude_(modest(amplitude, gamma)),
      rest_{require_positive("density", density), 0.0, require_positive("pressure", pressure)},
      frequency_(wave_number_ * sound_speed(rest_, gamma)) {}

double StandingWave::period() const { return 2.0 * std::numbers::pi / frequency_; }

double StandingWave::shock_formation_time() const { return 4.0 / ((gamma_ + 1.0) * amplitude_ * frequency_); }

/// The amplitudes of sin(k a) and sin(2 k a) in k s.
StandingWave::Pair StandingWave::harmonics(double t) const {
  double const phase = frequency_ * t;
  double const second = (gamma_ + 1.0) * amplitude_ * amplitude_ / 16.0;
  return {amplitude_ * std::sin(phase),
          second * (1.0 - std::cos(2.0 * phase) - phase * std::sin(2.0 * phase))};
}

/// Their derivatives by omega t.
StandingWave::Pair StandingWave::harmonic_rates(double t) const {
  double const phase = frequency_ * t;
  double const second = (gamma_ + 1.0) * amplitude_ * amplitude_ / 16.0;
  return {amplitude_ * std::cos(phase),
          second * (std::sin(2.0 * phase) - 2.0 * phase * std::cos(2.0 * phase))};
}

/// k a of the particle that is at x. To the formation time |k s| < 1 and |s_a| < 1, so that it is one.
double StandingWave::origin(double x, Pair const& s) const {
  double const place = wave_number_ * x;
  auto beyond = [&](double a) { return a + s.first * std::sin(a) + s.second * std::sin(2.0 * a) - place; };
  std::uintmax_t steps = 200;
  auto const [from, to] = boost::math::tools::toms748_solve(
      beyond, place - 1.0, place + 1.0, boost::math::tools::eps_tolerance<double>(), steps);
  return 0.5 * (from + to);
}

GasState StandingWave::at(double x, double t) const {
  if (double const latest = shock_formation_time(); require_not_negative("time", t) > latest) {
    throw BadValue("time", "at most " + brief(latest) + ", when the shock forms", brief(t));
  }
  Pair const s = harmonics(t);
  Pair const rate = harmonic_rates(t);
  double const a = origin(x, s);
  double const stretch = 1.0 + s.first * std::cos(a) + 2.0 * s.second * std::cos(2.0 * a);
  double const velocity = rate.first * std::sin(a) + rate.second * std::sin(2.0 * a);
  return {rest_.density / stretch, frequency_ / wave_number_ * velocity,
          rest_.pressure * std::pow(stretch, -gamma_)};
}

double StandingWave::accuracy() const {
  double const size = (gamma_ + 1.0) * amplitude_;
  return 2.0 * size * size * amplitude_ * frequency_ / wave_number_;
}

}  // namespace sphverify::exact
