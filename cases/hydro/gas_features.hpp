// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "cases/exact/riemann.hpp"
#include "cases/support/features.hpp"

namespace sphverify {

/// Where a fan ends in a vacuum: with the distance d from there the sound speed goes as d, so that density
/// goes as d^(2/(gamma-1)), pressure as d^(2 gamma/(gamma-1)), energy as d^2; the velocity has no kink in the
/// gas, but ends there. The mass within d goes as d^((gamma+1)/(gamma-1)): so much do particles of one mass
/// thin out.
inline Feature<1> vacuum_front(double gamma, double place) {
  Feature<1> front = plane_feature<1>("vacuum front",
                                      {{Field::density, 2.0 / (gamma - 1.0)},
                                       {Field::velocity, 1.0},
                                       {Field::pressure, 2.0 * gamma / (gamma - 1.0)},
                                       {Field::internal_energy, 2.0}},
                                      place);
  front.thinning = (gamma - 1.0) / (gamma + 1.0);
  return front;
}

/// Of two gases that met at a place at time 0: shocks, the corners in which fans begin and end, the contact,
/// vacuum fronts. Waves of no strength are left out.
/// @param time above 0
inline Features<1> riemann_features(exact::Riemann const& riemann, exact::GasState const& left,
                                    exact::GasState const& right, double gamma, double interface,
                                    double time) {
  constexpr double no_strength = 1e-9;  // what is told from rounding by far
  Features<1> features;
  auto const add = [&](char const* name, std::map<Field, double> exponents, double speed) {
    features.push_back(plane_feature<1>(name, std::move(exponents), interface + speed * time));
  };
  auto const waves = riemann.waves();
  auto const star = riemann.star();
  auto const differ = [](double a, double b) {
    return std::abs(a - b) > no_strength * std::max(std::abs(a), std::abs(b));
  };
  auto const add_wave = [&](exact::GasState const& side, double head, double tail) {
    if (!(side.density > 0.0)) return;
    if (star && !differ(star->pressure, side.pressure)) return;
    if (star && star->pressure > side.pressure) return add("shock", whole_gas(0.0), head);
    if (!star && side.pressure == 0.0) {  // cold gas keeps its edge
      return add("vacuum front", {{Field::density, 0.0}, {Field::velocity, 1.0}}, head);
    }
    add("fan head", whole_gas(1.0), head);
    if (star) return add("fan tail", whole_gas(1.0), tail);
    features.push_back(vacuum_front(gamma, interface + tail * time));
  };
  add_wave(left, waves.left_head, waves.left_tail);
  add_wave(right, waves.right_head, waves.right_tail);
  if (star) {
    std::map<Field, double> jumps;  // equal gases that met have no contact, but what the start did to them
    if (differ(star->density_left, star->density_right)) {
      jumps[Field::density] = 0.0;
      if (star->pressure > 0.0) jumps[Field::internal_energy] = 0.0;
    }
    bool const at_rest = features.empty() && jumps.empty();
    if (!at_rest) add("contact", jumps, waves.contact);
  }
  return features;
}

}  // namespace sphverify
