// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/viscosity/viscosity.hpp"

#include <algorithm>

#include "formulations/basics/expects.hpp"
#include "formulations/basics/parallel.hpp"
#include "formulations/particles/smoothing_length.hpp"
#include "formulations/walls/sweep_wall.hpp"

namespace sphverify {

namespace {

/// Of h: no nearer is a particle to the wall for mu. At twice that mu_ij is largest; nearer, its softening
/// takes it to nothing, as it may between two particles, whose kernel has no slope there: a wall's face
/// weight stays.
constexpr double nearest = 0.05;

/// By how much P_B of the wave that a wall sends into the gas is above the pressure of the gas at the foot
/// point.
template <int Dim>
double wave_pressure(WallContacts<Dim> const& contacts, std::size_t k, Particles<Dim> const& particles) {
  auto const& P = particles.scalar(Field::pressure);
  double sum = 0.0, weight = 0.0;
  for (std::size_t n = contacts.interpolation_first[k]; n < contacts.interpolation_first[k + 1]; ++n) {
    std::uint32_t const j = contacts.interpolation_neighbour[n];
    double const one =
        particles.masses()[j] / particles.scalar(Field::density)[j] * contacts.interpolation_kernel[n];
    sum += one * P[j];
    weight += one;
  }
  return std::max(0.0, contacts.pressure[k] - std::max(0.0, sum / weight));
}

/// How much of the wall's own share of the viscous stress P_B has already.
enum class WallStress { none, wave, whole };

/// What a wall, or a part of its contacts, gives per time.
template <int Dim>
struct WallExchange {
  Vector<Dim> force = Vector<Dim>::Zero();
  double power = 0.0;
};

template <class Law, int Dim>
WallExchange<Dim> add_viscous_wall(Law const& viscosity, WallContacts<Dim> const& contacts, WallStress in_pressure, double share,
                                   Particles<Dim> const& particles, int threads, ViscousRates<Dim>& rates) {
  expects(contacts.velocity.size() == contacts.size());
  expects(in_pressure != WallStress::wave || contacts.pressure.size() == contacts.size());
  SmoothingLength const h(particles);
  // A particle has one contact with a wall.
  auto const of_contact = [&](std::size_t k, WallExchange<Dim>& given) {
    std::uint32_t const i = contacts.particle[k];
    Vector<Dim> const v = particles.vector(Field::velocity)[i];
    double const closing = (v - contacts.velocity[k]).dot(contacts.outward_normal);
    if (closing <= 0.0) return;
    double const rho = 0.5 * (particles.scalar(Field::density)[i] + contacts.foot_density[k]);
    double const apart = 2.0 * std::max(contacts.distance[k],
                                        nearest * h(i));  // from its image, which closes in twice as fast
    auto const [mu, Pi] =
        viscosity.pair(-2.0 * closing * apart, h(i), particles.scalar(Field::sound_speed)[i], rho,
                       Law::divisor(apart * apart, h(i), rho));
    double const of_wall = share * Pi * rho * rho;  // [Pa]
    double const held = in_pressure == WallStress::none ? 0.0
                        : in_pressure == WallStress::whole
                            ? of_wall
                            : std::min(of_wall, 2.0 * share * wave_pressure(contacts, k, particles));
    double const face = (Pi - held / (rho * rho)) * contacts.foot_density[k] * contacts.face_weight[k];
    Vector<Dim> const acceleration = -face * contacts.outward_normal;
    double const heating = face * closing;
    rates.acceleration.add(i, acceleration);
    rates.heating[i] += heating;
    rates.largest_mu[i] = std::max(rates.largest_mu[i], -mu);
    double const m = particles.masses()[i];
    given.force += m * acceleration;
    given.power += m * (heating + acceleration.dot(v));
  };
  return joined_blocks(
      contacts.size(), threads, WallExchange<Dim>(),
      [&](std::size_t begin, std::size_t end) {
        WallExchange<Dim> given;
        for (std::size_t k = begin; k < end; ++k) of_contact(k, given);
        return given;
      },
      [](WallExchange<Dim>& all, WallExchange<Dim> const& part) {
        all.force += part.force;
        all.power += part.power;
      });
}

}  // namespace

template <int Dim>
void add_viscosity(Viscosity const& viscosity, Particles<Dim> const& particles, PairSweep<Dim>& sweep,
                   ViscousRates<Dim>& rates) {
  std::size_t const n = particles.size();
  if (rates.heating.size() != n)
    rates = {VectorField<Dim>(n), std::vector<double>(n), std::vector<double>(n), {}, {}};
  std::vector<double*> out;
  for (int k = 0; k < Dim; ++k) out.push_back(rates.acceleration.component(k).data());
  out.push_back(rates.heating.data());
  out.push_back(rates.largest_mu.data());
  SweepLoops const& loops = loops_of_sweep<Dim>();
  bool const is_monaghan = std::holds_alternative<MonaghanViscosity>(viscosity);
  std::visit(
      [&](auto const& law) {
        sweep.add(is_monaghan ? loops.viscosity : loops.riemann_viscosity,
                  {Field::mass, Field::density, Field::velocity, Field::sound_speed}, {KernelWeight::gradient}, out, &law);
      },
      viscosity);
}

namespace {

/// The pairs of a wall's contacts with what stands behind it.
template <int Dim>
void add_viscosity_behind(Viscosity const& viscosity, PairGeometry<Dim>& geometry, std::size_t wall,
                          Particles<Dim> const& fluid, double time, int threads, ViscousRates<Dim>& rates) {
  WallContacts<Dim> const& contacts = geometry.contacts[wall];
  WallParticles<Dim>& behind = geometry.behind[wall];
  fill_wall_particles(behind, contacts, geometry.walls, fluid,
                      {Field::mass, Field::density, Field::velocity, Field::sound_speed}, time);
  PairSweep<Dim> sweep(behind.pairs, geometry.domain, threads);
  ViscousRates<Dim> from_behind;
  add_viscosity(viscosity, behind.particles, sweep, from_behind);
  sweep.run(behind.particles);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    std::uint32_t const i = contacts.particle[c];
    Vector<Dim> const acceleration = from_behind.acceleration[c];
    rates.acceleration.add(i, acceleration);
    rates.heating[i] += from_behind.heating[c];
    rates.largest_mu[i] = std::max(rates.largest_mu[i], from_behind.largest_mu[c]);
    double const m = fluid.masses()[i];
    rates.wall_force[wall] += m * acceleration;
    rates.wall_power[wall] +=
        m * (from_behind.heating[c] + acceleration.dot(fluid.vector(Field::velocity)[i]));
  }
}

}  // namespace

template <int Dim>
void add_viscous_walls(Viscosity const& viscosity, Particles<Dim> const& particles,
                       PairGeometry<Dim>& geometry, Closure closure, double share, double time, int threads,
                       ViscousRates<Dim>& rates) {
  rates.wall_force.assign(geometry.contacts.size(), Vector<Dim>::Zero());
  rates.wall_power.assign(geometry.contacts.size(), 0.0);
  for (std::size_t w = 0; w < geometry.behind.size(); ++w)
    add_viscosity_behind(viscosity, geometry, w, particles, time, threads, rates);
  if (!geometry.behind.empty()) return;
  for (std::size_t w = 0; w < geometry.contacts.size(); ++w) {
    if (!geometry.walls[w].velocity) continue;
    Wall<Dim> const& wall = geometry.walls[w];
    bool const sends_a_wave =
        closure == Closure::one_sided && wall.gamma > 1.0 && particles.has(Field::pressure);
    WallStress const in_pressure = wall.pressure  ? WallStress::whole
                                   : sends_a_wave ? WallStress::wave
                                                  : WallStress::none;
    WallExchange<Dim> const given = std::visit(
        [&](auto const& law) {
          return add_viscous_wall(law, geometry.contacts[w], in_pressure, share, particles, threads, rates);
        },
        viscosity);
    rates.wall_force[w] += given.force;
    rates.wall_power[w] += given.power;
  }
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                                     \
  template void add_viscosity(Viscosity const&, Particles<Dim> const&, PairSweep<Dim>&,        \
                              ViscousRates<Dim>&);                                                     \
  template void add_viscous_walls(Viscosity const&, Particles<Dim> const&, PairGeometry<Dim>&, \
                                  Closure, double, double, int, ViscousRates<Dim>&);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
