// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/gas_manufactured.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double two_pi = 2.0 * pi;

/// The value of amplitude sin(phase) and what its derivatives by the phase are.
struct Wave {
  double value, first, second;
};

Wave wave(double amplitude, double phase) {
  double const value = amplitude * std::sin(phase);
  return {value, amplitude * std::cos(phase), -value};
}

struct Wall {
  double position, velocity, acceleration;
};

Wall left_wall(double t) {
  constexpr double rate = 2.7;
  static double const start = std::sin(0.4);
  Wave const w = wave(0.06, rate * t + 0.4);
  return {w.value - 0.06 * start, rate * w.first, rate * rate * w.second};
}

Wall right_wall(double t) {
  constexpr double rate = 4.1;
  static double const start = std::sin(0.9);
  Wave const w = wave(-0.05, rate * t - 0.9);
  return {1.0 + (w.value - 0.05 * start), rate * w.first, rate * rate * w.second};
}

Wall wall(int side, double t) {
  if (side == 0) return left_wall(t);
  if (side == 1) return right_wall(t);
  throw BadValue("side", "0 or 1", std::to_string(side));
}

/// Along x: the mass coordinate m and what follows from its derivatives.
struct Axis {
  double mass;
  double volume, volume_slope, volume_curvature;  // 1/m_x and its derivatives by x
  double velocity, acceleration, divergence;
};

Axis axis(double x, double t) {
  Wall const left = left_wall(t);
  Wall const right = right_wall(t);
  double const length = right.position - left.position;
  double const length_rate = right.velocity - left.velocity;
  double const zeta = (x - left.position) / length;

  // m and its derivatives by zeta (z) and t at fixed zeta.
  constexpr double k = 1.9;
  constexpr double rate = 1.7;
  static double const start = std::sin(0.4);
  Wave const fixed = wave(0.25, k * zeta + 0.4);
  Wave const swing = wave(0.2, rate * t + 0.3);
  Wave const shape = wave(1.0 / pi, pi * zeta);
  double const shape_slope = pi * shape.first;
  double const m = 1.2 * zeta + (fixed.value - 0.25 * start) / k + swing.value * shape.value;
  double const m_z = 1.2 + fixed.first + swing.value * shape_slope;
  double const m_zz = k * fixed.second + swing.value * pi * pi * shape.second;
  double const m_zzz = -k * k * fixed.first - swing.value * pi * pi * shape_slope;
  double const m_t = rate * swing.first * shape.value;
  double const m_tt = rate * rate * swing.second * shape.value;
  double const m_zt = rate * swing.first * shape_slope;

  // Particles drift through zeta at -m_t/m_z, and x = x_L + zeta L.
  double const drift = -m_t / m_z;
  double const drift_rate = -(m_tt + drift * m_zt) / m_z;
  double const drift_slope = -(m_zt + drift * m_zz) / m_z;

  Axis result;
  result.mass = m;
  result.volume = length / m_z;
  result.volume_slope = -m_zz / (m_z * m_z);
  result.volume_curvature = (2.0 * m_zz * m_zz / m_z - m_zzz) / (m_z * m_z * length);
  result.velocity = left.velocity + zeta * length_rate + length * drift;
  result.acceleration = left.acceleration + zeta * (right.acceleration - left.acceleration) +
                        2.0 * length_rate * drift + length * (drift_rate + drift * drift_slope);
  result.divergence = length_rate / length + drift_slope;
  return result;
}

/// Y(m, t) or Z(m, t): how far a particle has been carried across, with its derivatives by m and t.
struct Shift {
  double value, by_mass, by_mass_twice, rate, acceleration;
};

template <int Dim>
std::array<Shift, Dim - 1> shifts(double mass, double t) {
  constexpr double amplitude[] = {0.1, 0.08};
  constexpr double wave_number[] = {1.3, 0.9};
  constexpr double frequency[] = {2.3, -1.6};
  constexpr double start[] = {0.2, 2.0};
  std::array<Shift, Dim - 1> result;
  for (std::size_t i = 0; i + 1 < Dim; ++i) {
    double const k = wave_number[i];
    double const f = frequency[i];
    Wave const w = wave(amplitude[i], k * mass + f * t + start[i]);
    result[i] = {w.value, k * w.first, k * k * w.second, f * w.first, f * f * w.second};
  }
  return result;
}

/// A field at a point.
template <int Dim>
struct Field {
  double value;
  Vector<Dim> gradient;
  double laplacian;
};

/// 1/rho = h/m_x
template <int Dim>
Field<Dim> volume(Axis const& along, Vector<Dim> const& r, double t) {
  double phase = 0.0;
  double phase_slope = 0.0;      // by x
  double phase_curvature = 0.0;  // by x
  double const mass_slope = 1.0 / along.volume;
  double const mass_curvature = -along.volume_slope * mass_slope * mass_slope;
  auto const carried = shifts<Dim>(along.mass, t);
  for (int i = 1; i < Dim; ++i) {
    Shift const& shift = carried[static_cast<std::size_t>(i - 1)];
    phase += two_pi * (r[i] - shift.value);
    phase_slope -= two_pi * shift.by_mass * mass_slope;
    phase_curvature -=
        two_pi * (shift.by_mass_twice * mass_slope * mass_slope + shift.by_mass * mass_curvature);
  }

  Wave h{1.0, 0.0, 0.0};
  if (Dim > 1) h = wave(0.15, phase + 0.5 * pi);
  double const factor = Dim > 1 ? 1.0 + h.value : 1.0;
  Vector<Dim> phase_gradient = Vector<Dim>::Constant(two_pi);
  phase_gradient[0] = phase_slope;

  Field<Dim> result;
  result.value = along.volume * factor;
  result.gradient = along.volume * h.first * phase_gradient;
  result.gradient[0] += along.volume_slope * factor;
  result.laplacian = along.volume_curvature * factor + 2.0 * along.volume_slope * h.first * phase_slope +
                     along.volume * (h.second * phase_gradient.squaredNorm() + h.first * phase_curvature);
  return result;
}

constexpr double pressure_slope = 0.5;
constexpr double pressure_swing = 0.2;
constexpr double pressure_frequency = -1.9;

template <int Dim>
Vector<Dim> pressure_wave() {
  return Vector<3>(2.1, two_pi, -two_pi).head<Dim>();
}

template <int Dim>
Wave pressure_variation(Vector<Dim> const& r, double t) {
  return wave(pressure_swing, 0.5 + pressure_wave<Dim>().dot(r) + pressure_frequency * t);
}

template <int Dim>
Field<Dim> pressure_field(Vector<Dim> const& r, Wave const& variation) {
  Vector<Dim> const k = pressure_wave<Dim>();
  return {2.0 + pressure_slope * r[0] + variation.value,
          pressure_slope * Vector<Dim>::Unit(0) + variation.first * k, variation.second * k.squaredNorm()};
}

template <int Dim>
Field<Dim> product(Field<Dim> const& a, Field<Dim> const& b) {
  return {a.value * b.value, a.value * b.gradient + b.value * a.gradient,
          a.value * b.laplacian + 2.0 * a.gradient.dot(b.gradient) + b.value * a.laplacian};
}

template <int Dim>
Vector<Dim> velocity_at(Axis const& along, double t) {
  Vector<Dim> result;
  result[0] = along.velocity;
  auto const carried = shifts<Dim>(along.mass, t);
  for (int i = 1; i < Dim; ++i) result[i] = carried[static_cast<std::size_t>(i - 1)].rate;
  return result;
}

/// The particle's: m does not change for it, so that Y_tt at fixed m is its acceleration.
template <int Dim>
Vector<Dim> acceleration_at(Axis const& along, double t) {
  Vector<Dim> result;
  result[0] = along.acceleration;
  auto const carried = shifts<Dim>(along.mass, t);
  for (int i = 1; i < Dim; ++i) result[i] = carried[static_cast<std::size_t>(i - 1)].acceleration;
  return result;
}

constexpr double conductivity_slope = 0.2;

}  // namespace

template <int Dim>
GasManufactured<Dim>::GasManufactured(double gamma, double conductivity_scale)
    : gamma_(require_above("gamma", gamma, 1.0)),
      scale_(require_not_negative("conductivity", conductivity_scale)) {}

template <int Dim>
double GasManufactured<Dim>::density(Vector<Dim> const& r, double t) const {
  return 1.0 / volume<Dim>(axis(r[0], t), r, t).value;
}

template <int Dim>
Vector<Dim> GasManufactured<Dim>::velocity(Vector<Dim> const& r, double t) const {
  return velocity_at<Dim>(axis(r[0], t), t);
}

template <int Dim>
double GasManufactured<Dim>::pressure(Vector<Dim> const& r, double t) const {
  return pressure_field<Dim>(r, pressure_variation<Dim>(r, t)).value;
}

template <int Dim>
double GasManufactured<Dim>::internal_energy(Vector<Dim> const& r, double t) const {
  return pressure(r, t) / ((gamma_ - 1.0) * density(r, t));
}

template <int Dim>
double GasManufactured<Dim>::conductivity(double temperature) const {
  return scale_ * (1.0 + conductivity_slope * temperature);
}

template <int Dim>
Vector<Dim> GasManufactured<Dim>::flux(Vector<Dim> const& r, double t) const {
  Field<Dim> const energy =
      product<Dim>(pressure_field<Dim>(r, pressure_variation<Dim>(r, t)), volume<Dim>(axis(r[0], t), r, t));
  double const per_unit = 1.0 / (gamma_ - 1.0);
  return -conductivity(per_unit * energy.value) * per_unit * energy.gradient;
}

template <int Dim>
double GasManufactured<Dim>::wall_position(int side, double t) const {
  return wall(side, t).position;
}

template <int Dim>
double GasManufactured<Dim>::wall_velocity(int side, double t) const {
  return wall(side, t).velocity;
}

template <int Dim>
Vector<Dim> GasManufactured<Dim>::acceleration_source(Vector<Dim> const& r, double t) const {
  Axis const along = axis(r[0], t);
  Field<Dim> const pressure = pressure_field<Dim>(r, pressure_variation<Dim>(r, t));
  return acceleration_at<Dim>(along, t) + volume<Dim>(along, r, t).value * pressure.gradient;
}

/// As D(1/rho)/Dt = div v/rho, De/Dt + (P/rho) div v = (DP/Dt + gamma P div v)/((gamma-1) rho).
template <int Dim>
double GasManufactured<Dim>::heating_source(Vector<Dim> const& r, double t) const {
  Axis const along = axis(r[0], t);
  Wave const variation = pressure_variation<Dim>(r, t);
  Field<Dim> const pressure = pressure_field<Dim>(r, variation);
  Field<Dim> const per_mass = volume<Dim>(along, r, t);
  Field<Dim> const energy = product<Dim>(pressure, per_mass);

  double const pressure_rate =
      pressure_frequency * variation.first + velocity_at<Dim>(along, t).dot(pressure.gradient);
  double const per_unit = 1.0 / (gamma_ - 1.0);
  double const conducted = conductivity(per_unit * energy.value) * per_unit * energy.laplacian +
                           scale_ * conductivity_slope * per_unit * per_unit * energy.gradient.squaredNorm();
  return per_mass.value *
         (per_unit * (pressure_rate + gamma_ * pressure.value * along.divergence) - conducted);
}

template <int Dim>
double GasManufactured<Dim>::accuracy() const {
  return 2e-14;
}

template class GasManufactured<1>;
template class GasManufactured<2>;
template class GasManufactured<3>;

}  // namespace sphverify::exact
