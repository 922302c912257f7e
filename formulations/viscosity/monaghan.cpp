#include "formulations/viscosity/monaghan.hpp"

#include <algorithm>

#include "formulations/support/expects.hpp"
#include "formulations/support/smoothing_length.hpp"
#include "formulations/support/sweep.hpp"

namespace sphverify {

namespace {

template <int Dim>
void sweep_viscous_pairs(MonaghanViscosity const& viscosity, Particles<Dim> const& particles,
                         PairGeometry<Dim> const& geometry, Domain<Dim> const& domain, int threads,
                         ViscousRates<Dim>& rates) {
  SmoothingLength const h(particles);
  auto const& x = particles.positions();
  auto const& v = particles.vector(Field::velocity);
  auto const& m = particles.masses();
  auto const& rho = particles.scalar(Field::density);
  auto const& c = particles.scalar(Field::sound_speed);
  NeighbourList const& neighbours = geometry.neighbours;
  for_each_row(particles.size(), threads, [&](std::size_t i) {
    Vector<Dim> acceleration = Vector<Dim>::Zero();
    double heating = 0.0;
    double largest = 0.0;
    for (std::size_t k = neighbours.first[i]; k < neighbours.first[i + 1]; ++k) {
      std::uint32_t const j = neighbours.neighbour[k];
      Vector<Dim> const r_ij = domain.nearest_image(x[i] - x[j]);
      Vector<Dim> const v_ij = v[i] - v[j];
      double const mu = MonaghanViscosity::mu(v_ij.dot(r_ij), r_ij.squaredNorm(), h(i, j));
      if (mu == 0.0) continue;
      double const Pi = viscosity.pressure(mu, 0.5 * (c[i] + c[j]), 0.5 * (rho[i] + rho[j]));
      Vector<Dim> const gradient = geometry.weights.gradient[k];
      acceleration -= m[j] * Pi * gradient;
      heating += 0.5 * m[j] * Pi * v_ij.dot(gradient);
      largest = std::max(largest, -mu);
    }
    rates.acceleration.set(i, acceleration);
    rates.heating[i] = heating;
    rates.largest_mu[i] = largest;
  });
}

/// @param share of the wall's and the gas's halves that are left
template <int Dim>
void add_viscous_wall(MonaghanViscosity const& viscosity, WallContacts<Dim> const& contacts, double share,
                      Particles<Dim> const& particles, Vector<Dim>& force, double& power,
                      ViscousRates<Dim>& rates) {
  expects(contacts.velocity.size() == contacts.size());
  SmoothingLength const h(particles);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    std::uint32_t const i = contacts.particle[k];
    double const d = contacts.distance[k];
    Vector<Dim> const v = particles.vector(Field::velocity)[i];
    double const closing = (v - contacts.velocity[k]).dot(contacts.outward_normal);
    double const mu = MonaghanViscosity::mu(-closing * d, d * d, h(i));
    if (mu == 0.0) continue;
    double const rho = 0.5 * (particles.scalar(Field::density)[i] + contacts.foot_density[k]);
    double const Pi = viscosity.pressure(mu, particles.scalar(Field::sound_speed)[i], rho);
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
void evaluate_viscosity(MonaghanViscosity const& viscosity, Particles<Dim> const& particles,
                        PairGeometry<Dim> const& geometry, Domain<Dim> const& domain, Closure closure,
                        int threads, ViscousRates<Dim>& rates) {
  std::size_t const n = particles.size();
  if (rates.heating.size() != n)
    rates = {VectorField<Dim>(n), std::vector<double>(n), std::vector<double>(n), {}, {}};
  sweep_viscous_pairs(viscosity, particles, geometry, domain, threads, rates);
  rates.wall_force.assign(geometry.contacts.size(), Vector<Dim>::Zero());
  rates.wall_power.assign(geometry.contacts.size(), 0.0);
  for (std::size_t w = 0; w < geometry.contacts.size(); ++w) {
    if (!geometry.walls[w].velocity) continue;
    bool const whole_stress = geometry.walls[w].pressure || closure == Closure::one_sided;
    add_viscous_wall(viscosity, geometry.contacts[w], whole_stress ? 0.5 : 1.0, particles,
                     rates.wall_force[w], rates.wall_power[w], rates);
  }
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                             \
  template void evaluate_viscosity(MonaghanViscosity const&, Particles<Dim> const&,            \
                                   PairGeometry<Dim> const&, Domain<Dim> const&, Closure, int, \
                                   ViscousRates<Dim>&);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
