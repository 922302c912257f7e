// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/piston_shock.hpp"

#include <cmath>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

PistonShock::PistonShock(double initial_pressure, double post_pressure, double density, double gamma)
    : ahead_{require_positive("density", density), 0.0,
             require_not_negative("initial_pressure", initial_pressure)} {
  require_above("gamma", gamma, 1.0);
  require_positive("pressure", post_pressure);
  if (post_pressure < initial_pressure) {
    throw BadValue("pressure", "at least the initial_pressure, " + brief(initial_pressure),
                   brief(post_pressure));
  }
  double const numerator = (gamma + 1.0) * post_pressure + (gamma - 1.0) * initial_pressure;
  double const denominator = (gamma - 1.0) * post_pressure + (gamma + 1.0) * initial_pressure;
  double const mass_flow = std::sqrt(0.5 * density * numerator);
  behind_ = {density * numerator / denominator, (post_pressure - initial_pressure) / mass_flow,
             post_pressure};
  shock_speed_ = mass_flow / density;
}

double PistonShock::piston_velocity() const { return behind_.velocity; }

double PistonShock::shock_speed() const { return shock_speed_; }

double PistonShock::post_density() const { return behind_.density; }

GasState PistonShock::at(double x, double t) const {
  return x < shock_speed_ * require_not_negative("time", t) ? behind_ : ahead_;
}

double PistonShock::accuracy() const { return 1e-14; }

}  // namespace sphverify::exact
