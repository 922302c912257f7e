// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/barenblatt.hpp"

#include <algorithm>
#include <cmath>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

Barenblatt::Barenblatt(double exponent, double constant, double start_time)
    : exponent_(require_above("exponent", exponent, 1.0)),
      constant_(require_positive("constant", constant)),
      start_time_(require_positive("start_time", start_time)),
      spread_(1.0 / (exponent + 1.0)),
      curvature_((exponent - 1.0) / (2.0 * exponent * (exponent + 1.0))) {}

double Barenblatt::elapsed(double t) const { return start_time_ + require_above("time", t, -start_time_); }

/// The front's place in y = x tau^-a.
double Barenblatt::reach() const { return std::sqrt(constant_ / curvature_); }

double Barenblatt::temperature(double x, double t) const {
  double const place = std::abs(x) / front(t);
  if (place >= 1.0) return 0.0;
  // C - k y^2 in factors, because the difference would lose its digits near the front.
  double const base = constant_ * (1.0 - place) * (1.0 + place);
  return std::pow(elapsed(t), -spread_) * std::pow(base, 1.0 / (exponent_ - 1.0));
}

double Barenblatt::gradient(double x, double t) const {
  double const value = temperature(x, t);
  return value > 0.0 ? -flux(x, t) / conductivity(value) : 0.0;
}

double Barenblatt::flux(double x, double t) const { return spread_ * x * temperature(x, t) / elapsed(t); }

double Barenblatt::front(double t) const { return reach() * std::pow(elapsed(t), spread_); }

double Barenblatt::conductivity(double temperature) const {
  return exponent_ * std::pow(std::max(temperature, 0.0), exponent_ - 1.0);
}

double Barenblatt::total_energy() const {
  double const power = 1.0 / (exponent_ - 1.0);
  return std::pow(constant_, power) * reach() * std::beta(0.5, power + 1.0);
}

double Barenblatt::accuracy() const { return 1e-12 * exponent_ / (exponent_ - 1.0) * temperature(0.0, 0.0); }

}  // namespace sphverify::exact
