// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/riemann.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

namespace {

GasState const& require_gas_or_vacuum(std::string const& side, GasState const& state) {
  require_finite(side + "[1]", state.velocity);
  if (require_not_negative(side + "[2]", state.pressure) > 0.0)
    require_positive(side + "[0]", state.density);
  else
    require_not_negative(side + "[0]", state.density);
  return state;
}

/// The right side is the left side of the mirror image.
GasState mirrored(GasState const& state) { return {state.density, -state.velocity, state.pressure}; }

/// -f_K(0): how much the gas speeds up if it expands into a vacuum.
double escape_speed(GasState const& gas, double gamma) {
  return 2.0 * sound_speed(gas, gamma) / (gamma - 1.0);
}

/// Q_K: what passes a shock into this gas per area and second.
double mass_flow(GasState const& gas, double pressure, double gamma) {
  return std::sqrt(0.5 * gas.density * ((gamma + 1.0) * pressure + (gamma - 1.0) * gas.pressure));
}

struct Slowing {
  double velocity;   // f_K(P)
  double steepness;  // df_K/d(ln P), a speed; the slope itself overflows next to a vacuum
};

/// Expects pressure > 0.
Slowing slowing(GasState const& gas, double pressure, double gamma) {
  if (pressure > gas.pressure) {
    double const flow = mass_flow(gas, pressure, gamma);
    double const change = (pressure - gas.pressure) / flow;
    return {change, (1.0 - 0.25 * (gamma + 1.0) * gas.density * change / flow) * pressure / flow};
  }
  // Neither a weak fan nor a gamma close to 1 may cost digits, hence expm1.
  double const log_slower = 0.5 * (gamma - 1.0) / gamma * std::log(pressure / gas.pressure);
  return {escape_speed(gas, gamma) * std::expm1(log_slower),
          sound_speed(gas, gamma) / gamma * std::exp(log_slower)};
}

/// f_L + f_R + u_R - u_L and its steepness.
Slowing mismatch(GasState const& left, GasState const& right, double pressure, double gamma) {
  Slowing const l = slowing(left, pressure, gamma);
  Slowing const r = slowing(right, pressure, gamma);
  return {l.velocity + r.velocity + (right.velocity - left.velocity), l.steepness + r.steepness};
}

bool vacuum_opens(GasState const& left, GasState const& right, double gamma) {
  double const parting = right.velocity - left.velocity;
  double const escape = escape_speed(left, gamma) + escape_speed(right, gamma);
  return parting >= escape && parting > 0.0;  // cold streams side by side leave no gap
}

/// 0 if cold streams do not collide.
double contact_pressure(GasState const& left, GasState const& right, double gamma) {
  double const closing = left.velocity - right.velocity;
  double pressure =
      std::max({left.pressure, right.pressure, std::min(left.density, right.density) * closing * closing});
  if (pressure == 0.0) return 0.0;
  double const negligible = 1e-280 * pressure;
  while (mismatch(left, right, pressure, gamma).velocity > 0.0) {
    pressure /= 16.0;
    require_positive("pressure at the contact", pressure > negligible ? pressure : 0.0);
  }
  for (;;) {
    Slowing const miss = mismatch(left, right, pressure, gamma);
    double const next = pressure * (1.0 - miss.velocity / miss.steepness);
    if (!(next > pressure)) return pressure;
    pressure = next;
  }
}

/// Behind the wave that brings the gas to this pressure.
double density_behind(GasState const& gas, double pressure, double gamma) {
  if (pressure <= gas.pressure)
    return pressure == gas.pressure ? gas.density
                                    : gas.density * std::pow(pressure / gas.pressure, 1.0 / gamma);
  double const sum = gamma + 1.0;
  double const difference = gamma - 1.0;
  return gas.density * (sum * pressure + difference * gas.pressure) /
         (difference * pressure + sum * gas.pressure);
}

Riemann::Star star_between(GasState const& left, GasState const& right, double pressure, double gamma) {
  double const slowed_left = pressure > 0.0 ? slowing(left, pressure, gamma).velocity : 0.0;
  double const slowed_right = pressure > 0.0 ? slowing(right, pressure, gamma).velocity : 0.0;
  return {pressure, 0.5 * ((left.velocity - slowed_left) + (right.velocity + slowed_right)),
          density_behind(left, pressure, gamma), density_behind(right, pressure, gamma)};
}

struct Edges {
  double head;
  double tail;
};

/// Of the wave that runs to the left, into `gas`, and leaves the state `behind`.
Edges left_wave(GasState const& gas, GasState const& behind, double gamma) {
  if (behind.pressure > gas.pressure) {
    double const shock = gas.velocity - mass_flow(gas, behind.pressure, gamma) / gas.density;
    return {shock, shock};
  }
  return {gas.velocity - sound_speed(gas, gamma), behind.velocity - sound_speed(behind, gamma)};
}

Riemann::Waves waves_about_star(GasState const& left, GasState const& right, Riemann::Star const& star,
                                double gamma) {
  GasState const inner_left{star.density_left, star.velocity, star.pressure};
  GasState const inner_right{star.density_right, star.velocity, star.pressure};
  Edges const l = left_wave(left, inner_left, gamma);
  Edges const r = left_wave(mirrored(right), mirrored(inner_right), gamma);
  return {l.head, l.tail, star.velocity, -r.tail, -r.head};
}

Riemann::Waves waves_about_vacuum(GasState const& left, GasState const& right, double gamma) {
  double const head_left = left.velocity - sound_speed(left, gamma);
  double const head_right = right.velocity + sound_speed(right, gamma);
  double const front_left = left.velocity + escape_speed(left, gamma);
  double const front_right = right.velocity - escape_speed(right, gamma);
  if (left.density == 0.0) return {front_right, front_right, front_right, front_right, head_right};
  if (right.density == 0.0) return {head_left, front_left, front_left, front_left, front_left};
  return {head_left, front_left, 0.5 * (front_left + front_right), front_right, head_right};
}

/// Waves too weak to notice may have been rounded past each other.
Riemann::Waves ascending(Riemann::Waves waves) {
  waves.left_tail = std::max(waves.left_tail, waves.left_head);
  waves.contact = std::max(waves.contact, waves.left_tail);
  waves.right_tail = std::max(waves.right_tail, waves.contact);
  waves.right_head = std::max(waves.right_head, waves.right_tail);
  return waves;
}

/// Inside the fan that runs to the left, where dx/dt = u - c and u + 2 c/(gamma-1) is that of the gas.
GasState left_fan(GasState const& gas, double speed, double gamma) {
  double const sound = sound_speed(gas, gamma);
  double const depth = (speed - gas.velocity) + sound;
  double const slower = std::max(0.0, 1.0 - (gamma - 1.0) / (gamma + 1.0) * depth / sound);  // c / c_K
  return {gas.density * std::pow(slower, 2.0 / (gamma - 1.0)), gas.velocity + 2.0 / (gamma + 1.0) * depth,
          gas.pressure * std::pow(slower, 2.0 * gamma / (gamma - 1.0))};
}

}  // namespace

Riemann::Riemann(GasState const& left, GasState const& right, double gamma)
    : left_(require_gas_or_vacuum("left", left)),
      right_(require_gas_or_vacuum("right", right)),
      gamma_(require_above("gamma", gamma, 1.0)) {
  require_positive("density of one side", std::max(left.density, right.density));
  bool const touching = left.density > 0.0 && right.density > 0.0 && !vacuum_opens(left, right, gamma);
  if (touching) star_ = star_between(left, right, contact_pressure(left, right, gamma), gamma);
  waves_ = ascending(star_ ? waves_about_star(left, right, *star_, gamma)
                           : waves_about_vacuum(left, right, gamma));
  require_finite("speed of a wave", waves_.left_head);
  require_finite("speed of a wave", waves_.right_head);
}

GasState Riemann::at(double speed) const {
  if (std::isnan(speed)) require_finite("speed", speed);
  if (speed < waves_.left_head) return left_;
  if (speed < waves_.left_tail) return left_fan(left_, speed, gamma_);
  if (speed < waves_.right_tail) {
    if (!star_) return {0.0, speed, 0.0};
    return {speed < waves_.contact ? star_->density_left : star_->density_right, star_->velocity,
            star_->pressure};
  }
  if (speed < waves_.right_head) return mirrored(left_fan(mirrored(right_), -speed, gamma_));
  return right_;
}

std::optional<Riemann::Star> Riemann::star() const { return star_; }

Riemann::Waves const& Riemann::waves() const { return waves_; }

double Riemann::accuracy() const {
  double const fastest =
      std::max({std::abs(left_.velocity), std::abs(right_.velocity), std::abs(waves_.left_head),
                std::abs(waves_.left_tail), std::abs(waves_.right_tail), std::abs(waves_.right_head)});
  double lost = 2.0 * gamma_ / (gamma_ - 1.0);  // digits lost by a fan's highest power
  // A fan's edge that is rounded to another place.
  if (waves_.left_head < waves_.left_tail) lost = std::max(lost, fastest / sound_speed(left_, gamma_));
  if (waves_.right_tail < waves_.right_head) lost = std::max(lost, fastest / sound_speed(right_, gamma_));
  if (star_ && star_->pressure > 0.0) {
    // The velocities that cancel in the equation for the pressure, over how steeply it depends on that.
    Slowing const l = slowing(left_, star_->pressure, gamma_);
    Slowing const r = slowing(right_, star_->pressure, gamma_);
    double const cancelling =
        std::abs(l.velocity) + std::abs(r.velocity) + std::abs(right_.velocity - left_.velocity);
    double const relative = cancelling / (l.steepness + r.steepness);
    double const inner = std::max(star_->density_left, star_->density_right);
    double const densest = std::max({inner, left_.density, right_.density});
    double const highest = std::max({star_->pressure, left_.pressure, right_.pressure});
    lost = std::max(lost, relative * std::max(inner / densest, star_->pressure / highest));
  }
  return 16.0 * std::numeric_limits<double>::epsilon() * lost;
}

}  // namespace sphverify::exact
