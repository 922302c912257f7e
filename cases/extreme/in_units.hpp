// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "cases/exact/require.hpp"
#include "cases/support/problem.hpp"
#include "formulations/basics/expects.hpp"

namespace sphverify {

/// Units in which a problem is told anew, in those it had. The specific heat counts as 1 in any of them, so
/// that the unit of temperature is free; heat is then counted in mass times temperature.
struct Units {
  double length = 1.0, mass = 1.0, time = 1.0, temperature = 1.0;
};

/// The factors that numbers take, of `Dim` dimensions: densities are masses per length^Dim.
template <int Dim>
class UnitFactors {
 public:
  /// Throws BadValue unless all are positive, finite and as precise as other numbers.
  explicit UnitFactors(Units const& units) : units_(units) {
    density = units.mass;
    for (int k = 0; k < Dim; ++k) density /= units.length;
    velocity = units.length / units.time;
    energy = velocity * velocity;
    pressure = density * energy;
    acceleration = velocity / units.time;
    heating = units.temperature / units.time;
    flux = density * velocity * units.temperature;
    conductivity = density * velocity * units.length;
    for (double const factor : {units.length, units.mass, units.time, units.temperature, density, velocity,
                                energy, pressure, acceleration, heating, flux, conductivity}) {
      exact::require_positive("every unit", factor);
      if (!std::isnormal(factor)) {
        throw BadValue("every derived unit", "above 1e-307", exact::brief(factor));
      }
    }
  }

  double density, velocity, energy, pressure, acceleration, heating, flux, conductivity;

  double of(Field field) const {
    switch (field) {
      case Field::density:
        return density;
      case Field::pressure:
        return pressure;
      case Field::internal_energy:
        return energy;
      case Field::velocity:
        return velocity;
      case Field::temperature:
        return units_.temperature;
      case Field::flux:
        return flux;
      default:
        throw std::invalid_argument("no case prescribes this field");
    }
  }

 private:
  Units units_;
};

/// The same problem with every length, mass, time and temperature multiplied. Whatever of it is computed must
/// be multiplied too and nothing else: to the last bit where the factors are powers of 2, to rounding
/// otherwise. Landmarks are left out, since nothing tells their units.
/// Throws as `UnitFactors` does. Expects a problem in time, of a gas or of heat but not of both, without
/// energy released at a point.
template <int Dim>
Problem<Dim> in_units(Problem<Dim> problem, Units const& units) {
  expects(problem.final_time > 0.0 && !problem.point_energy);
  expects(problem.gamma == 0.0 || !problem.conductivity);
  using Point = Vector<Dim>;
  UnitFactors<Dim> const factors(units);
  double const length = units.length;
  double const time = units.time;
  // Works on functions that give numbers and on those that give vectors.
  auto const multiply = [=](auto& f, double factor) {
    if (!f) return;
    f = [=, old = std::move(f)](Point const& x, double t) -> decltype(f(x, t)) {
      return factor * old(x / length, t / time);
    };
  };

  problem.domain.lower *= length;
  problem.domain.upper *= length;
  for (Wall<Dim>& wall : problem.walls) {
    wall.point *= length;
    multiply(wall.pressure, factors.pressure);
    multiply(wall.velocity, factors.velocity);
    multiply(wall.temperature, units.temperature);
    multiply(wall.conductivity, factors.conductivity);
    multiply(wall.flux, factors.flux);
    if (wall.heat_loss) {
      wall.heat_loss = HeatLoss{
          .flux = [factor = factors.flux, unit = units.temperature,
                   old = std::move(wall.heat_loss->flux)](double T) { return factor * old(T / unit); },
          .environment = units.temperature * wall.heat_loss->environment};
    }
    if (wall.path) {
      wall.path = [=, old = std::move(wall.path)](double t) -> Point { return length * old(t / time); };
    }
  }
  for (double& jump : problem.initial_jumps) jump *= length;
  for (auto& [field, f] : problem.scalars) multiply(f, factors.of(field));
  for (auto& [field, f] : problem.vectors) multiply(f, factors.of(field));
  if (problem.conductivity) {
    problem.conductivity = [=, factor = factors.conductivity, temperature = units.temperature,
                            old = std::move(problem.conductivity)](Point const& x, double T) {
      return factor * old(x / length, T / temperature);
    };
  }
  multiply(problem.source, problem.gamma > 0.0 ? factors.energy / time : factors.heating);
  multiply(problem.body_force, factors.acceleration);
  if (problem.shocks) {
    problem.shocks = [=, old = std::move(problem.shocks)](double t) {
      auto fronts = old(t / time);
      for (ShockFront& front : fronts) {
        for (double* place : {&front.position, &front.plateau_lower, &front.plateau_upper}) *place *= length;
        for (double* pressure : {&front.pressure_ahead, &front.pressure}) *pressure *= factors.pressure;
        front.density *= factors.density;
        front.velocity *= factors.velocity;
      }
      return fronts;
    };
  }
  if (problem.features) {
    problem.features = [=, old = std::move(problem.features)](double t) {
      Features<Dim> features = old(t / time);
      for (Feature<Dim>& one : features) {
        one.width *= length;
        one.distance = [length, was = std::move(one.distance)](Point const& x) {
          return length * was(x / length);
        };
      }
      return features;
    };
  }
  if (problem.holds) {
    problem.holds = [=, old = std::move(problem.holds)](Point const& x, double t) {
      return old(x / length, t / time);
    };
  }
  problem.landmarks.clear();
  problem.final_time *= time;
  if (problem.gamma == 0.0) problem.accuracy *= units.temperature;  // that of a gas is relative
  return problem;
}

}  // namespace sphverify
