// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

/// f(x) = x^degree + 1 with its derivatives; degree 0 is the constant state f = 1 + 1 = 2.
/// Exact to round-off.
class PolynomialProfile {
 public:
  explicit PolynomialProfile(int degree) : n_(degree) {}

  double value(double x) const { return power(x, n_) + 1.0; }
  double first_derivative(double x) const { return n_ < 1 ? 0.0 : n_ * power(x, n_ - 1); }
  double second_derivative(double x) const { return n_ < 2 ? 0.0 : n_ * (n_ - 1.0) * power(x, n_ - 2); }

 private:
  static double power(double x, int n) { return n == 0 ? 1.0 : std::pow(x, n); }
  int n_;
};

/// f(x) = offset + sin(k x + phase) with its derivatives; k in 1/m. Exact to round-off.
class SineProfile {
 public:
  SineProfile(double wavenumber, double phase, double offset)
      : k_(require_finite("wavenumber", wavenumber)),
        phase_(require_finite("phase", phase)),
        offset_(require_finite("offset", offset)) {}

  double value(double x) const { return offset_ + std::sin(k_ * x + phase_); }
  double first_derivative(double x) const { return k_ * std::cos(k_ * x + phase_); }
  double second_derivative(double x) const { return -k_ * k_ * std::sin(k_ * x + phase_); }

 private:
  double k_, phase_, offset_;
};

}  // namespace sphverify::exact
