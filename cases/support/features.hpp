// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "formulations/particles/field.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// A surface, line or point at which the exact solution is not smooth at some time. There a field is a smooth
/// one plus a part that goes as d^s on one side, d the distance: s = 0 is a jump, 1 a kink, 1/n the front of
/// heat conduction with K ~ T^n. What it allows of the order of an error: harness/measure/allowed_order.hpp.
template <int Dim>
struct Feature {
  std::string name;  ///< shock, contact, corner, front, kink, interface, ...

  /// s of the fields that are not smooth there, where it is below 2. None: the solution is smooth there, but
  /// the gas has kept what the start from a jump did to it (wall heating, for instance).
  std::map<Field, double> exponents;

  std::function<double(Vector<Dim> const& x)> distance;  ///< of a place from it, not negative [m]
  int codimension = 1;                                   ///< of a surface 1, of a point that of space

  /// Particles that stood dx apart stand a multiple of dx^thinning apart near it: below 1 next to a vacuum.
  double thinning = 1.0;

  double width = 0.0;  ///< over which it is smooth after all [m]: who resolves that finds no feature
};

template <int Dim>
using Features = std::vector<Feature<Dim>>;

/// One across the first axis, at x = place.
template <int Dim>
Feature<Dim> plane_feature(std::string name, std::map<Field, double> exponents, double place) {
  return {std::move(name), std::move(exponents),
          [place](Vector<Dim> const& x) { return std::abs(x[0] - place); }};
}

/// A circle or sphere about the origin (in 1D the plane at x = radius and its image).
template <int Dim>
Feature<Dim> round_feature(std::string name, std::map<Field, double> exponents, double radius) {
  return {std::move(name), std::move(exponents),
          [radius](Vector<Dim> const& x) { return std::abs(x.norm() - radius); }};
}

/// The fields of a gas that all go as d^s.
inline std::map<Field, double> whole_gas(double s) {
  return {{Field::density, s}, {Field::velocity, s}, {Field::pressure, s}, {Field::internal_energy, s}};
}

/// A contact: pressure and velocity are the same on both sides.
inline std::map<Field, double> density_and_energy(double s) {
  return {{Field::density, s}, {Field::internal_energy, s}};
}

/// Leaves out what allows every order: a field that goes as d^s with s of 2 or more.
inline std::map<Field, double> rough(std::map<Field, double> exponents) {
  std::erase_if(exponents, [](auto const& one) { return one.second >= 2.0; });
  return exponents;
}

}  // namespace sphverify
