// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/walls/wall_out_of_reach.hpp"

#include <algorithm>

#include "formulations/basics/expects.hpp"
#include "formulations/walls/wall_riemann.hpp"

namespace sphverify {

template <int Dim>
Vector<Dim> velocity_out_of_reach(Wall<Dim> const& wall, Particles<Dim> const& particles, Closure closure,
                                  double time) {
  std::size_t const n = particles.size();
  expects(n > 0);
  bool const sends_a_wave = closure == Closure::one_sided && wall.gamma > 1.0 && wall.pressure;
  if (closure != Closure::quotient && !sends_a_wave) return Vector<Dim>::Zero();
  std::size_t nearest = 0;
  double distance = wall.distance(particles.positions()[0]);
  for (std::size_t i = 1; i < n; ++i) {
    double const d = wall.distance(particles.positions()[i]);
    if (d >= distance) continue;
    nearest = i;
    distance = d;
  }
  Vector<Dim> const v = particles.vector(Field::velocity)[nearest];
  if (!sends_a_wave) return v;
  double const rho = particles.scalar(Field::density)[nearest];
  double const P = std::max(0.0, particles.scalar(Field::pressure)[nearest]);
  double const closing = closing_speed_at_wall(rho, P, wall.pressure(wall.point, time), wall.gamma);
  return v - closing * wall.outward_normal;
}

#define SPHVERIFY_INSTANTIATE(Dim) \
  template Vector<Dim> velocity_out_of_reach(Wall<Dim> const&, Particles<Dim> const&, Closure, double);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
