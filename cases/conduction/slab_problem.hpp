// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <stdexcept>

#include "cases/exact/mode.hpp"
#include "cases/exact/require.hpp"
#include "cases/support/boxes.hpp"
#include "cases/support/parameters.hpp"
#include "cases/support/problem.hpp"

namespace sphverify {

/// The parts that all conduction cases share whose exact solution `temperature(x, t)`, `gradient(x, t)`
/// depends on the first coordinate only: domain, two walls that prescribe nothing yet, uniform density,
/// conductivity, temperature and flux.
template <int Dim, class Exact>
Problem<Dim> conduction_problem(Exact const& exact, Domain<Dim> const& domain, double density,
                                std::function<double(double temperature)> conductivity,
                                bool depends_on_temperature) {
  using Point = Vector<Dim>;
  Problem<Dim> problem;
  problem.domain = domain;
  problem.walls = slab_walls(domain);
  problem.scalars[Field::density] = [density](Point const&, double) { return density; };
  problem.scalars[Field::temperature] = [exact](Point const& x, double t) {
    return exact.temperature(x[0], t);
  };
  problem.conductivity = [conductivity](Point const&, double T) { return conductivity(T); };
  problem.conductivity_depends_on_temperature = depends_on_temperature;
  problem.vectors[Field::flux] = [exact, conductivity](Point const& x, double t) {
    double const slope = exact.gradient(x[0], t);
    return along_first_axis<Dim>(slope == 0.0 ? 0.0 : -conductivity(exact.temperature(x[0], t)) * slope);
  };
  problem.accuracy = exact.accuracy();
  return problem;
}

/// Where heat ends that runs into T = 0 with K ~ T^n: T^n goes as the distance d, and the flux, T times the
/// front's speed, as T.
template <int Dim>
Feature<Dim> heat_front(double n, std::function<double(Vector<Dim> const& x)> distance) {
  return {"front", rough({{Field::temperature, 1.0 / n}, {Field::flux, 1.0 / n}}), std::move(distance)};
}

/// Makes a wall prescribe the exact temperature, and the conductivity that belongs to it.
template <int Dim>
void prescribe_temperature(Problem<Dim>& problem, Wall<Dim>& wall) {
  auto const temperature = problem.scalars.at(Field::temperature);
  auto const conductivity = problem.conductivity;
  wall.temperature = temperature;
  wall.conductivity = [temperature, conductivity](Vector<Dim> const& x, double t) {
    return conductivity(x, temperature(x, t));
  };
}

/// Makes a wall prescribe a constant flux along the first axis.
template <int Dim>
void prescribe_flux(Wall<Dim>& wall, double flux) {
  wall.flux = [flux](Vector<Dim> const&, double) { return along_first_axis<Dim>(flux); };
}

/// [[number, amplitude], ...] as modes.
inline std::vector<exact::Mode> modes(std::vector<std::vector<double>> const& table) {
  std::vector<exact::Mode> modes;
  for (auto const& row : table) {
    std::string const place = "modes[" + std::to_string(modes.size()) + "]";
    if (row.size() != 2)
      throw BadValue(place, "[number, amplitude]", "a list of " + std::to_string(row.size()));
    if (!(row[0] >= 1.0 && row[0] <= 1e6) || row[0] != std::floor(row[0])) {
      throw BadValue(place + "[0]", "a whole number from 1 to 1e6", exact::brief(row[0]));
    }
    modes.push_back({static_cast<int>(row[0]), row[1]});
  }
  return modes;
}

}  // namespace sphverify
