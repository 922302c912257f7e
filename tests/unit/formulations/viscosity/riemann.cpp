// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/viscosity/viscosity.hpp"

#include <boost/test/unit_test.hpp>

#include "formulations/walls/wall_riemann.hpp"
#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_viscosity_riemann)

using namespace sphverify;
using namespace sphverify::tests;

constexpr double gamma = 1.4;

template <int Dim>
ViscousRates<Dim> viscous(RandomScene<Dim> const& given) {
  RandomScene<Dim> scene = given;
  PairGeometry<Dim> geometry = geometry_of(scene, false);
  Viscosity const viscosity = RiemannViscosity{gamma};
  ViscousRates<Dim> rates;
  PairSweep<Dim> sweep(geometry.neighbours, geometry.domain, 1);
  add_viscosity(viscosity, scene.particles, sweep, rates);
  sweep.run(scene.particles);
  return rates;
}

/// The pressure at a wall that half of the speed of approach runs into, less the gas's own: the mirror image is the second
/// of two equal states.
double excess(double rho, double c, double approach) {
  double const P = rho * c * c / gamma;
  return pressure_at_wall(rho, P, 0.5 * approach, gamma) - P;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_the_star_pressure_above_two_equal_states, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = random_scene<Dim>(7, 40);
  dense::State<Dim> const s(scene);
  auto const& c = scene.particles.scalar(Field::sound_speed);
  ViscousRates<Dim> const found = viscous(scene);
  double worst = 0.0, size = 0.0;
  for (std::size_t i = 0; i < s.particles(); ++i) {
    Vector<Dim> a = Vector<Dim>::Zero();
    double heating = 0.0;
    for (std::size_t j = 0; j < s.particles(); ++j) {
      if (j == i) continue;
      Vector<Dim> const r = s.x(i) - s.x(j);
      double const approach = -(s.v(i) - s.v(j)).dot(r) / r.norm();
      if (approach <= 0.0 || r.norm() >= 2.0 * s.h()) continue;
      double const rho = 0.5 * (s.rho(i) + s.rho(j));
      Vector<Dim> const push = s.m(j) * 2.0 * excess(rho, 0.5 * (c[i] + c[j]), approach) / (rho * rho) * s.gradient(i, j);
      a -= push;
      heating += 0.5 * (s.v(i) - s.v(j)).dot(push);
    }
    worst = std::max({worst, (found.acceleration[i] - a).norm(), std::abs(found.heating[i] - heating)});
    size = std::max({size, a.norm(), heating});
    BOOST_TEST(found.heating[i] >= 0.0);
  }
  BOOST_TEST(worst < 1e-9 * size);
}

BOOST_AUTO_TEST_CASE(pairs_conserve_momentum_and_energy_and_those_that_part_do_not_rub) {
  RandomScene<2> scene = random_scene<2>(8, 50);
  ViscousRates<2> const rates = viscous(scene);
  Vector<2> force = Vector<2>::Zero();
  double power = 0.0, gross = 0.0;
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    double const m = scene.particles.masses()[i];
    force += m * rates.acceleration[i];
    power += m * (rates.heating[i] + rates.acceleration[i].dot(scene.particles.vector(Field::velocity)[i]));
    gross += m * rates.heating[i];
  }
  BOOST_TEST(force.norm() < 1e-12 * gross);
  BOOST_TEST(std::abs(power) < 1e-12 * gross);
  for (std::size_t i = 0; i < scene.particles.size(); ++i)
    scene.particles.vector(Field::velocity).set(i, scene.particles.positions()[i]);
  for (double const heating : viscous(scene).heating) BOOST_TEST(heating == 0.0);
}

/// One particle that comes with speed w towards a wall at rest, whose image comes with -w: the wall's half is q, and so is the
/// gas's, of which P_B may hold its share.
BOOST_AUTO_TEST_CASE(a_wall_pushes_with_twice_the_excess_over_rho_less_what_its_pressure_holds) {
  auto const push = [](Closure closure, double share, bool prescribed) {
    RandomScene<1> scene = lattice_scene<1>(20, 0.1, 1.2);
    auto& p = scene.particles;
    p.allocate({Field::sound_speed});
    p.scalar(Field::density).assign(20, 1.0);
    p.scalar(Field::pressure).assign(20, 0.5);
    p.scalar(Field::sound_speed).assign(20, std::sqrt(gamma * 0.5));
    p.vector(Field::velocity).component(0).assign(20, 0.3);
    Wall<1> wall{.point = Vector<1>(1.0), .outward_normal = Vector<1>(1.0)};
    wall.gamma = gamma;
    wall.velocity = [](Vector<1> const&, double) { return Vector<1>(0.0); };
    if (prescribed) wall.pressure = [](Vector<1> const&, double) { return 0.5; };
    scene.walls.push_back(wall);
    PairGeometry<1> geometry = geometry_of(scene, true);
    fill_boundary_values(geometry.contacts[0], geometry.walls[0], p, {BoundaryValue::pressure, BoundaryValue::velocity}, closure, 0.0);
    Viscosity const viscosity = RiemannViscosity{gamma};
    ViscousRates<1> rates;
    PairSweep<1> sweep(geometry.neighbours, geometry.domain, 1);
    add_viscosity(viscosity, p, sweep, rates);
    sweep.run(p);
    add_viscous_walls(viscosity, p, geometry, closure, share, 0.0, 1, rates);
    auto const& contacts = geometry.contacts[0];
    double const rho = 0.5 * (1.0 + contacts.foot_density[0]);
    double const face = contacts.foot_density[0] * contacts.face_weight[0];
    double const q = excess(rho, std::sqrt(gamma * 0.5), 0.6);
    return -rates.acceleration[contacts.particle[0]][0] / face * rho * rho / q;  // in q
  };
  BOOST_TEST(push(Closure::interpolated, 0.5, false) == 2.0, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(push(Closure::interpolated, 0.5, true) == 1.0, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(std::abs(push(Closure::interpolated, 1.0, true)) < 1e-9);
  // The gas at the foot point is that of the particle, up to the densities that the kernel sees.
  BOOST_TEST(push(Closure::one_sided, 0.5, false) == 1.0, boost::test_tools::tolerance(0.05));
  BOOST_TEST(std::abs(push(Closure::one_sided, 1.0, false)) < 0.05);
}

BOOST_AUTO_TEST_CASE(cold_gas_is_stopped_by_the_pressure_of_a_strong_shock) {
  // q = (gamma + 1)/2 rho w^2
  auto const [mu, Pi] = RiemannViscosity{gamma}.pair(-0.6, 1.0, 0.0, 2.0, RiemannViscosity::divisor(0.09, 1.0, 2.0));
  BOOST_TEST(mu == -2.0, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(Pi == 2.0 * (0.5 * (gamma + 1.0) * 2.0 * 1.0) / 4.0, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
