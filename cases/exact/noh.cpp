// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/noh.hpp"

#include <cmath>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

Noh::Noh(int dimension, double gamma)
    : dimension_(require_positive("dimension", dimension)), gamma_(require_above("gamma", gamma, 1.0)) {}

GasState Noh::at(double r, double t) const {
  require_not_negative("radius", r);
  require_not_negative("time", t);
  if (r < shock_speed() * t) {
    double const density = std::pow((gamma_ + 1.0) / (gamma_ - 1.0), dimension_);
    return {density, 0.0, 0.5 * (gamma_ - 1.0) * density};
  }
  return {t > 0.0 ? std::pow(1.0 + t / r, dimension_ - 1) : 1.0, -1.0, 0.0};
}

double Noh::shock_speed() const { return 0.5 * (gamma_ - 1.0); }

double Noh::accuracy() const { return 1e-15 * (dimension_ + 1); }

}  // namespace sphverify::exact
