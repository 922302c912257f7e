// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/two_layer.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <numbers>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

namespace {

using std::numbers::pi;

/// delta less the angle whose tangent is tan(theta/S)/S.
double mismatch(double delta, double stretch) {
  double const inner = (pi - delta) / stretch;
  return delta - std::atan2(std::sin(inner), stretch * std::cos(inner));
}

double slowest(double stretch) {
  gsl_function function;
  function.function = [](double delta, void* data) { return mismatch(delta, *static_cast<double*>(data)); };
  function.params = &stretch;
  std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> const solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), &gsl_root_fsolver_free);
  if (!solver) throw std::bad_alloc();
  gsl_root_fsolver_set(solver.get(), &function, 0.0, pi);
  constexpr int most_steps = 200;
  constexpr double relative = 2.0 * std::numeric_limits<double>::epsilon();
  for (int step = 0; step < most_steps; ++step) {
    gsl_root_fsolver_iterate(solver.get());
    double const lower = gsl_root_fsolver_x_lower(solver.get());
    double const upper = gsl_root_fsolver_x_upper(solver.get());
    if (gsl_root_test_interval(lower, upper, 0.0, relative) == GSL_SUCCESS) break;
  }
  return gsl_root_fsolver_root(solver.get());
}

}  // namespace

TwoLayer::TwoLayer(double left, double right, double contrast, double amplitude)
    : left_(require_finite("left", left)),
      right_(require_finite("right", right)),
      contrast_(require_positive("contrast", contrast)),
      amplitude_(require_finite("amplitude", amplitude)),
      stretch_(std::sqrt(std::max(contrast, 1.0 / contrast))),
      delta_(slowest(require_finite("square root of the contrast", stretch_))),
      share_(std::sin(delta_) / std::sin(phase() / stretch_)) {}

double TwoLayer::phase() const { return pi - delta_; }

double TwoLayer::decay_rate() const { return 4.0 * std::min(1.0, contrast_) * phase() * phase(); }

double TwoLayer::conductivity(double x) const { return x < 0.5 ? 1.0 : contrast_; }

double TwoLayer::shape(double x) const {
  double const z = contrast_ >= 1.0 ? x : 1.0 - x;
  bool const poor = (x < 0.5) == (contrast_ >= 1.0);
  return poor ? std::sin(2.0 * phase() * z) : share_ * std::sin(2.0 * phase() * (1.0 - z) / stretch_);
}

double TwoLayer::shape_slope(double x) const {
  double const z = contrast_ >= 1.0 ? x : 1.0 - x;
  double const along = contrast_ >= 1.0 ? 1.0 : -1.0;  // dz/dx
  bool const poor = (x < 0.5) == (contrast_ >= 1.0);
  double const k = 2.0 * phase();
  return along * k * (poor ? std::cos(k * z) : -share_ / stretch_ * std::cos(k * (1.0 - z) / stretch_));
}

double TwoLayer::departure(double t) const {
  return amplitude_ * std::exp(-decay_rate() * require_not_negative("time", t));
}

double TwoLayer::temperature(double x, double t) const {
  // From the wall of each layer, so that neither loses its small rise to the other's.
  double const rise = 2.0 * (right_ - left_) / (1.0 + contrast_);  // slope of the right layer
  double const steady = x < 0.5 ? left_ + contrast_ * rise * x : right_ - rise * (1.0 - x);
  return steady + departure(t) * shape(x);
}

double TwoLayer::gradient(double x, double t) const {
  double const rise = 2.0 * (right_ - left_) / (1.0 + contrast_);
  return (x < 0.5 ? contrast_ * rise : rise) + departure(t) * shape_slope(x);
}

double TwoLayer::flux(double x, double t) const { return -conductivity(x) * gradient(x, t); }

double TwoLayer::accuracy() const {
  return 8.0 * std::numeric_limits<double>::epsilon() *
         (std::abs(left_) + std::abs(right_) + (1.0 + 2.0 * pi) * std::abs(amplitude_));
}

}  // namespace sphverify::exact
