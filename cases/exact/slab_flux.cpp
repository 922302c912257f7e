// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/slab_flux.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double switch_time = 0.1;        // kappa t up to which images are used
constexpr double negligible_power = 42.0;  // exp(-42) < 1e-18: no term beyond it changes a double

/// Integral of erfc from z to infinity.
double ierfc(double z) { return std::exp(-z * z) * std::numbers::inv_sqrtpi - z * std::erfc(z); }

int mode_count(double kappa_t) {
  return static_cast<int>(std::ceil(std::sqrt(negligible_power / kappa_t) / pi));
}

int image_count(double length) { return static_cast<int>(0.5 * std::sqrt(negligible_power) * length); }

}  // namespace

SlabFlux::SlabFlux(double initial, double flux, double conductivity, double density)
    : initial_(require_finite("initial", initial)),
      flux_(require_finite("flux", flux)),
      conductivity_(require_positive("conductivity", conductivity)),
      density_(require_positive("density", density)) {}

bool SlabFlux::is_early(double t) const { return conductivity_ / density_ * t <= switch_time; }

double SlabFlux::temperature(double x, double t) const {
  return is_early(t) ? temperature_by_images(x, t) : temperature_by_modes(x, t);
}

double SlabFlux::gradient(double x, double t) const {
  return is_early(t) ? gradient_by_images(x, t) : gradient_by_modes(x, t);
}

double SlabFlux::temperature_by_modes(double x, double t) const {
  double const kappa_t = conductivity_ / density_ * require_positive("time", t);
  double sum = 0.0;
  for (int n = mode_count(kappa_t); n >= 1; --n) {
    double const k = n * pi;
    sum += std::exp(-k * k * kappa_t) * std::cos(k * x) / (k * k);
  }
  double const steady_shape = 0.5 * (1.0 - x) * (1.0 - x) - 1.0 / 6.0;
  return initial_ + flux_ * t / density_ + flux_ / conductivity_ * (steady_shape - 2.0 * sum);
}

double SlabFlux::gradient_by_modes(double x, double t) const {
  double const kappa_t = conductivity_ / density_ * require_positive("time", t);
  double sum = 0.0;
  for (int n = mode_count(kappa_t); n >= 1; --n) {
    double const k = n * pi;
    sum += std::exp(-k * k * kappa_t) * std::sin(k * x) / k;
  }
  return flux_ / conductivity_ * (2.0 * sum - (1.0 - x));
}

double SlabFlux::temperature_by_images(double x, double t) const {
  if (t == 0.0) return initial_;
  double const length = 2.0 * std::sqrt(conductivity_ / density_ * require_positive("time", t));
  double sum = 0.0;
  for (int n = image_count(length); n >= 0; --n) {
    sum += ierfc((2.0 * n + x) / length) + ierfc((2.0 * n + 2.0 - x) / length);
  }
  return initial_ + flux_ / conductivity_ * length * sum;
}

double SlabFlux::gradient_by_images(double x, double t) const {
  if (t == 0.0) return x > 0.0 ? 0.0 : -flux_ / conductivity_;
  double const length = 2.0 * std::sqrt(conductivity_ / density_ * require_positive("time", t));
  double sum = 0.0;
  for (int n = image_count(length); n >= 0; --n) {
    sum += std::erfc((2.0 * n + 2.0 - x) / length) - std::erfc((2.0 * n + x) / length);
  }
  return flux_ / conductivity_ * sum;
}

double SlabFlux::accuracy() const {
  double const scale = std::max(1.0, std::abs(initial_)) + std::abs(flux_) / conductivity_;
  return 8.0 * std::numeric_limits<double>::epsilon() * scale;
}

}  // namespace sphverify::exact
