#pragma once

#include <cmath>
#include <stdexcept>

#include "cases/exact/mode.hpp"
#include "cases/support/boxes.hpp"
#include "cases/support/parameters.hpp"
#include "cases/support/problem.hpp"

namespace sphverify {

/// The parts that all 1D conduction cases with an exact solution `temperature(x, t)`, `gradient(x, t)` share:
/// domain, two walls that prescribe nothing yet, uniform density, conductivity, temperature and flux.
template <class Exact>
Problem<1> conduction_problem(Exact const& exact, Domain<1> const& domain, double density,
                              std::function<double(double temperature)> conductivity,
                              bool depends_on_temperature) {
  Problem<1> problem;
  problem.domain = domain;
  problem.walls = slab_walls(domain);
  problem.scalars[Field::density] = [density](Vector<1> const&, double) { return density; };
  problem.scalars[Field::temperature] = [exact](Vector<1> const& x, double t) {
    return exact.temperature(x[0], t);
  };
  problem.conductivity = [conductivity](Vector<1> const&, double T) { return conductivity(T); };
  problem.conductivity_depends_on_temperature = depends_on_temperature;
  problem.vectors[Field::flux] = [exact, conductivity](Vector<1> const& x, double t) {
    double const slope = exact.gradient(x[0], t);
    return Vector<1>(slope == 0.0 ? 0.0 : -conductivity(exact.temperature(x[0], t)) * slope);
  };
  problem.accuracy = exact.accuracy();
  return problem;
}

/// Makes a wall prescribe the exact temperature, and the conductivity that belongs to it.
inline void prescribe_temperature(Problem<1>& problem, Wall<1>& wall) {
  auto const temperature = problem.scalars.at(Field::temperature);
  auto const conductivity = problem.conductivity;
  wall.temperature = temperature;
  wall.conductivity = [temperature, conductivity](Vector<1> const& x, double t) {
    return conductivity(x, temperature(x, t));
  };
}

/// Makes a wall prescribe a constant flux vector.
inline void prescribe_flux(Wall<1>& wall, double flux) {
  wall.flux = [flux](Vector<1> const&, double) { return Vector<1>(flux); };
}

/// [[number, amplitude], ...] as modes.
inline std::vector<exact::Mode> modes(std::vector<std::vector<double>> const& table) {
  std::vector<exact::Mode> modes;
  for (auto const& row : table) {
    if (row.size() != 2) throw std::invalid_argument("modes must be a list of [number, amplitude]");
    if (!(row[0] >= 1.0 && row[0] <= 1e6) || row[0] != std::floor(row[0])) {
      throw std::invalid_argument("a mode's number must be whole, from 1 to 1e6");
    }
    modes.push_back({static_cast<int>(row[0]), row[1]});
  }
  return modes;
}

}  // namespace sphverify
