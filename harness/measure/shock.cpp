// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/shock.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sphverify {

namespace {

/// Part of the plateau that is left out at either end, where fronts are smeared.
constexpr double plateau_margin = 0.2;

template <int Dim>
Number position_of(Particles<Dim> const& particles, ShockFront const& front) {
  auto const& x = particles.positions().component(0);
  auto const& P = particles.scalar(Field::pressure);
  double const middle = 0.5 * (front.pressure_ahead + front.pressure);
  std::vector<std::size_t> order(particles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return x[i] < x[j]; });
  Number nearest;
  for (std::size_t k = 0; k + 1 < order.size(); ++k) {
    std::size_t const i = order[k];
    std::size_t const j = order[k + 1];
    if ((P[i] - middle) * (P[j] - middle) > 0.0 || P[i] == P[j]) continue;
    double const crossing = x[i] + (middle - P[i]) / (P[j] - P[i]) * (x[j] - x[i]);
    if (!nearest || std::abs(crossing - front.position) < std::abs(*nearest - front.position))
      nearest = crossing;
  }
  return nearest;
}

}  // namespace

template <int Dim>
ShockRecord measure_shock(Particles<Dim> const& particles, ShockFront const& front) {
  ShockRecord record;
  record.position = front.position;
  if (Number const found = position_of(particles, front)) record.position_error = *found - front.position;

  double const margin = plateau_margin * (front.plateau_upper - front.plateau_lower);
  double volume = 0.0, density = 0.0, velocity = 0.0, pressure = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    double const x = particles.positions()[i][0];
    if (x < front.plateau_lower + margin || x > front.plateau_upper - margin) continue;
    double const V = particles.masses()[i] / particles.scalar(Field::density)[i];
    volume += V;
    density += V * particles.scalar(Field::density)[i];
    velocity += V * particles.vector(Field::velocity)[i][0];
    pressure += V * particles.scalar(Field::pressure)[i];
  }
  if (volume == 0.0) return record;
  record.plateau_density = density / volume / front.density - 1.0;
  record.plateau_pressure = pressure / volume / front.pressure - 1.0;
  record.plateau_velocity = velocity / volume - front.velocity;
  return record;
}

template ShockRecord measure_shock(Particles<1> const&, ShockFront const&);
template ShockRecord measure_shock(Particles<2> const&, ShockFront const&);
template ShockRecord measure_shock(Particles<3> const&, ShockFront const&);

}  // namespace sphverify
