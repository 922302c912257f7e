// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/conducting_shock.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

namespace {

/// ln(1 + exp(y))
double softplus(double y) { return std::max(y, 0.0) + std::log1p(std::exp(-std::abs(y))); }

/// 1/(1 + exp(-y))
double logistic(double y) { return 1.0 / (1.0 + std::exp(-y)); }

double continuous(double post_pressure, double initial_pressure, double gamma) {
  require_above("pressure", post_pressure, initial_pressure);
  if (post_pressure * (3.0 - gamma) < initial_pressure * (gamma + 1.0)) return post_pressure;
  throw BadValue("pressure",
                 "below " + brief(initial_pressure * (gamma + 1.0) / (3.0 - gamma)) +
                     " for conduction alone to smooth the shock",
                 brief(post_pressure));
}

/// Of the jump conditions, without the difference of two near speeds.
double mass_flux(double initial_pressure, double post_pressure, double density, double gamma) {
  return std::sqrt(0.5 * density * ((gamma + 1.0) * post_pressure + (gamma - 1.0) * initial_pressure));
}

}  // namespace

ConductingShock::ConductingShock(double initial_pressure, double post_pressure, double density,
                                 double conductivity, double gamma, double centre)
    : initial_pressure_(require_positive("initial_pressure", initial_pressure)),
      gamma_(require_above("gamma", gamma, 1.0)),
      post_pressure_(continuous(post_pressure, initial_pressure, gamma)),
      density_(require_positive("density", density)),
      centre_(require_finite("centre", centre)),
      mass_flux_(mass_flux(initial_pressure, post_pressure, density, gamma)),
      conduction_length_(2.0 * require_positive("conductivity", conductivity) /
                         (mass_flux_ * (gamma + 1.0))) {}

double ConductingShock::shock_speed() const { return mass_flux_ / density_; }

double ConductingShock::piston_velocity() const { return (post_pressure_ - initial_pressure_) / mass_flux_; }

double ConductingShock::length_ahead() const {
  return conduction_length_ * ((gamma_ + 1.0) * post_pressure_ - (3.0 - gamma_) * initial_pressure_) /
         (2.0 * (post_pressure_ - initial_pressure_));
}

double ConductingShock::length_behind() const {
  return conduction_length_ * ((gamma_ + 1.0) * initial_pressure_ - (3.0 - gamma_) * post_pressure_) /
         (2.0 * (post_pressure_ - initial_pressure_));
}

/// y = ln(q/(1-q)) grows with xi by between 1/a and 1/b.
double ConductingShock::logit(double x, double t) const {
  double const a = length_ahead();
  double const b = length_behind();
  double const xi = x - centre_ - shock_speed() * t;
  auto beyond = [&](double y) {
    return a * softplus(y) - b * softplus(-y) - (a - b) * std::numbers::ln2 - xi;
  };
  auto const [low, high] = std::minmax({xi / a, xi / b});
  auto margin = [](double y) { return 1e-9 * (1.0 + std::abs(y)); };  // for rounding
  std::uintmax_t steps = 200;
  auto const [from, to] = boost::math::tools::toms748_solve(
      beyond, low - margin(low), high + margin(high), boost::math::tools::eps_tolerance<double>(), steps);
  return 0.5 * (from + to);
}

GasState ConductingShock::at(double x, double t) const {
  double const passed = logistic(-logit(x, t));  // 1 - q
  double const velocity = piston_velocity() * passed;
  return {mass_flux_ / (shock_speed() - velocity), velocity,
          initial_pressure_ + (post_pressure_ - initial_pressure_) * passed};
}

double ConductingShock::temperature(double x, double t) const {
  GasState const state = at(x, t);
  return state.pressure / ((gamma_ - 1.0) * state.density);
}

double ConductingShock::flux(double x, double t) const {
  double const y = logit(x, t);
  double const jump = piston_velocity();
  return mass_flux_ * (gamma_ + 1.0) / (2.0 * (gamma_ - 1.0)) * jump * jump * logistic(y) * logistic(-y);
}

double ConductingShock::accuracy() const { return 32.0 * std::numeric_limits<double>::epsilon(); }

}  // namespace sphverify::exact
