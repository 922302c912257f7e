// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/gresho.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

Gresho::Gresho(double central_pressure)
    : central_pressure_(require_positive("pressure in the centre", central_pressure)) {}

// P = v^2/(gamma M^2) where v = 1, and 1/2 less in the centre.
double Gresho::central_pressure(double gamma, double mach) {
  require_above("gamma", gamma, 1.0);
  require_positive("mach", mach);
  double const pressure = 1.0 / (gamma * mach * mach) - 0.5;
  if (pressure > 0.0) return pressure;
  throw BadValue("mach", "below " + brief(std::sqrt(2.0 / gamma)) + " for a positive pressure", brief(mach));
}

double Gresho::velocity(double r) const { return r * angular_velocity(r); }

double Gresho::angular_velocity(double r) const {
  if (require_not_negative("radius", r) <= fastest) return 5.0;
  return r <= edge ? 2.0 / r - 5.0 : 0.0;
}

double Gresho::pressure(double r) const {
  if (require_not_negative("radius", r) <= fastest) return central_pressure_ + 12.5 * r * r;
  if (r <= edge) return central_pressure_ + 4.0 + 12.5 * r * r - 20.0 * r + 4.0 * std::log(5.0 * r);
  return central_pressure_ - 2.0 + 4.0 * std::numbers::ln2;
}

double Gresho::accuracy() const {
  // What cancels is of order 4, and the least that is left is the central pressure.
  return 8.0 * std::numeric_limits<double>::epsilon() * (1.0 + 1.0 / central_pressure_);
}

}  // namespace sphverify::exact
