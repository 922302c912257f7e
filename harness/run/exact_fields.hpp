// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "cases/support/problem.hpp"
#include "formulations/particles/smoothing_length.hpp"
#include "reports/extremes.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// A function of place and time at every particle.
template <int Dim>
std::vector<double> sample(ScalarFunction<Dim> const& f, Particles<Dim> const& particles, double time) {
  std::vector<double> values(particles.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = f(particles.positions()[i], time);
  return values;
}

template <int Dim>
VectorField<Dim> sample(VectorFunction<Dim> const& f, Particles<Dim> const& particles, double time) {
  VectorField<Dim> values(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) values.set(i, f(particles.positions()[i], time));
  return values;
}

/// The components of a field as lists.
template <int Dim>
std::vector<std::span<double const>> components(VectorField<Dim> const& field) {
  std::vector<std::span<double const>> lists;
  for (int k = 0; k < Dim; ++k) lists.emplace_back(field.component(k));
  return lists;
}

/// Weights of the norms: V_i = m_i / exact density, or m_i / rho_i where that is zero.
template <int Dim>
std::vector<double> exact_volumes(Problem<Dim> const& problem, Particles<Dim> const& particles, double time) {
  std::vector<double> volumes = sample(problem.scalars.at(Field::density), particles, time);
  auto const& computed = particles.scalar(Field::density);
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    // NaN stays: it must not pass for a vacuum.
    volumes[i] = particles.masses()[i] / (volumes[i] <= 0.0 ? computed[i] : volumes[i]);
  }
  return volumes;
}

/// The exact heat flux into the fluid through a wall [W/m^2], averaged over the foot points of the particles
/// that see it; empty where none does.
/// @param volumes weights, one per particle
template <int Dim>
Number exact_wall_flux(VectorFunction<Dim> const& flux, Wall<Dim> const& wall,
                       Particles<Dim> const& particles, std::vector<double> const& volumes, double time) {
  SmoothingLength const h(particles);
  double sum = 0.0;
  double weight = 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < particles.size(); ++i) nearest = std::min(nearest, wall.distance(particles.positions()[i]));
  for (std::size_t i = 0; i < particles.size(); ++i) {
    Vector<Dim> const x = particles.positions()[i];
    // Where none is near the wall the nearest stands for it.
    if (wall.distance(x) >= std::max(h.support(i), nearest * (1.0 + 1e-12))) continue;
    sum -= volumes[i] * flux(wall.foot(x), time).dot(wall.outward_normal);
    weight += volumes[i];
  }
  return weight != 0.0 ? Number(sum / weight) : std::nullopt;
}

/// NaN if one of them is.
inline double largest_magnitude(std::span<double const> values) {
  double largest = 0.0;
  for (double const value : values) largest = larger(largest, std::abs(value));
  return largest;
}

}  // namespace sphverify
