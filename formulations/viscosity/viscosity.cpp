#include "formulations/viscosity/viscosity.hpp"

#include <algorithm>

#include "formulations/basics/expects.hpp"
#include "formulations/particles/smoothing_length.hpp"
#include "formulations/walls/sweep_wall.hpp"

namespace sphverify {

namespace {

/// @param share of the wall's and the gas's halves that are left
template <class Law, int Dim>
void add_viscous_wall(Law const& viscosity, WallContacts<Dim> const& contacts, double share,
                      Particles<Dim> const& particles, Vector<Dim>& force, double& power,
                      ViscousRates<Dim>& rates) {
  expects(contacts.velocity.size() == contacts.size());
  SmoothingLength const h(particles);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    std::uint32_t const i = contacts.particle[k];
    double const d = contacts.distance[k];
    Vector<Dim> const v = particles.vector(Field::velocity)[i];
    double const closing = (v - contacts.velocity[k]).dot(contacts.outward_normal);
    if (closing <= 0.0) continue;
    double const rho = 0.5 * (particles.scalar(Field::density)[i] + contacts.foot_density[k]);
    auto const [mu, Pi] = viscosity.pair(-closing * d, h(i), particles.scalar(Field::sound_speed)[i], rho,
                                         Law::divisor(d * d, h(i), rho));
    double const face = share * Pi * contacts.foot_density[k] * contacts.face_weight[k];
    Vector<Dim> const acceleration = -face * contacts.outward_normal;
    double const heating = face * closing;
    rates.acceleration.add(i, acceleration);
    rates.heating[i] += heating;
    rates.largest_mu[i] = std::max(rates.largest_mu[i], -mu);
    double const m = particles.masses()[i];
    force += m * acceleration;
    power += m * (heating + acceleration.dot(v));
  }
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
  SweepKernels const& loops = sweep_kernels<Dim>(particles.kernel().id());
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
    rates.wall_power[wall] += m * (from_behind.heating[c] + acceleration.dot(fluid.vector(Field::velocity)[i]));
  }
}

}  // namespace

template <int Dim>
void add_viscous_walls(Viscosity const& viscosity, Particles<Dim> const& particles,
                       PairGeometry<Dim>& geometry, Closure closure, double time, int threads, ViscousRates<Dim>& rates) {
  rates.wall_force.assign(geometry.contacts.size(), Vector<Dim>::Zero());
  rates.wall_power.assign(geometry.contacts.size(), 0.0);
  for (std::size_t w = 0; w < geometry.behind.size(); ++w)
    add_viscosity_behind(viscosity, geometry, w, particles, time, threads, rates);
  if (!geometry.behind.empty()) return;
  for (std::size_t w = 0; w < geometry.contacts.size(); ++w) {
    if (!geometry.walls[w].velocity) continue;
    bool const whole_stress = geometry.walls[w].pressure || closure == Closure::one_sided;
    std::visit(
        [&](auto const& law) {
          add_viscous_wall(law, geometry.contacts[w], whole_stress ? 0.5 : 1.0, particles, rates.wall_force[w],
                           rates.wall_power[w], rates);
        },
        viscosity);
  }
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                                           \
  template void add_viscosity(Viscosity const&, Particles<Dim> const&, PairSweep<Dim>&,              \
                              ViscousRates<Dim>&);                                                           \
  template void add_viscous_walls(Viscosity const&, Particles<Dim> const&, PairGeometry<Dim>&,       \
                                  Closure, double, int, ViscousRates<Dim>&);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
