// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/mode.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

double Mode::wavenumber() const { return number * std::numbers::pi; }

double Mode::decay(double conductivity_over_density, double t) const {
  return std::exp(-wavenumber() * wavenumber() * conductivity_over_density * t);
}

std::vector<Mode> require_modes(std::vector<Mode> modes) {
  for (Mode const& mode : modes) {
    require_positive("mode number", mode.number);
    require_finite("mode amplitude", mode.amplitude);
  }
  return modes;
}

double rounding(std::vector<Mode> const& modes) {
  double sum = 0.0;
  for (Mode const& mode : modes) sum += std::abs(mode.amplitude) * (1.0 + mode.wavenumber());
  return 2.0 * std::numeric_limits<double>::epsilon() * sum;
}

}  // namespace sphverify::exact
