// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/conduction_manufactured.hpp"

#include <cmath>
#include <numbers>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double slope = 0.6;
constexpr double swing = 0.3;  // of density and conductivity

/// A plane wave's phase, start + wave . r.
template <int Dim>
struct Phase {
  double start;
  Vector<Dim> wave;
  double at(Vector<Dim> const& r) const { return start + wave.dot(r); }
};

template <int Dim>
Phase<Dim> density_phase() {
  return {0.9, Vector<3>(1.7, -two_pi, two_pi).head<Dim>()};
}

template <int Dim>
Phase<Dim> temperature_phase() {
  return {0.4, Vector<3>(2.3, two_pi, two_pi).head<Dim>()};
}

template <int Dim>
Phase<Dim> conductivity_phase() {
  return {0.7, Vector<3>(3.1, two_pi, -two_pi).head<Dim>()};
}

double amplitude(double t) { return 0.25 * (1.0 + std::exp(-require_not_negative("time", t))); }

double amplitude_rate(double t) { return -0.25 * std::exp(-t); }

double temperature_factor(double temperature) { return 0.5 + 0.1 * temperature * temperature; }

double temperature_factor_slope(double temperature) { return 0.2 * temperature; }

}  // namespace

template <int Dim>
ConductionManufactured<Dim>::ConductionManufactured(double conductivity_scale)
    : scale_(require_positive("conductivity", conductivity_scale)) {}

template <int Dim>
double ConductionManufactured<Dim>::temperature(Vector<Dim> const& r, double t) const {
  return 2.0 + slope * r[0] + amplitude(t) * std::sin(temperature_phase<Dim>().at(r));
}

template <int Dim>
Vector<Dim> ConductionManufactured<Dim>::temperature_gradient(Vector<Dim> const& r, double t) const {
  Phase<Dim> const phase = temperature_phase<Dim>();
  return slope * Vector<Dim>::Unit(0) + amplitude(t) * std::cos(phase.at(r)) * phase.wave;
}

template <int Dim>
double ConductionManufactured<Dim>::density(Vector<Dim> const& r) const {
  return 1.3 + swing * std::cos(density_phase<Dim>().at(r));
}

template <int Dim>
double ConductionManufactured<Dim>::conductivity(Vector<Dim> const& r, double temperature) const {
  return scale_ * (1.0 + swing * std::sin(conductivity_phase<Dim>().at(r))) * temperature_factor(temperature);
}

template <int Dim>
Vector<Dim> ConductionManufactured<Dim>::flux(Vector<Dim> const& r, double t) const {
  return -conductivity(r, temperature(r, t)) * temperature_gradient(r, t);
}

template <int Dim>
double ConductionManufactured<Dim>::source(Vector<Dim> const& r, double t) const {
  Phase<Dim> const c = temperature_phase<Dim>();
  Phase<Dim> const d = conductivity_phase<Dim>();
  double const value = temperature(r, t);
  Vector<Dim> const gradient = temperature_gradient(r, t);
  double const wave = std::sin(c.at(r));

  double const rate = amplitude_rate(t) * wave;
  double const laplacian = -amplitude(t) * wave * c.wave.squaredNorm();
  double const slope_by_temperature =
      scale_ * (1.0 + swing * std::sin(d.at(r))) * temperature_factor_slope(value);
  Vector<Dim> const gradient_by_place =
      scale_ * swing * std::cos(d.at(r)) * temperature_factor(value) * d.wave;

  double const divergence = conductivity(r, value) * laplacian + gradient_by_place.dot(gradient) +
                            slope_by_temperature * gradient.squaredNorm();
  return rate - divergence / density(r);
}

template <int Dim>
double ConductionManufactured<Dim>::accuracy() const {
  return 1e-14;
}

template class ConductionManufactured<1>;
template class ConductionManufactured<2>;
template class ConductionManufactured<3>;

}  // namespace sphverify::exact
