// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_work_sqrt_p)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "work/sqrt-p";

/// The partner of Eq. 20, as its header derives it.
template <int Dim>
std::vector<double> equation(dense::State<Dim> const& s, bool with_walls) {
  std::vector<double> rate(s.particles(), 0.0);
  for (std::size_t i = 0; i < s.particles(); ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < s.particles(); ++j) {
      sum += s.m(j) * std::sqrt(s.P(j)) / s.rho(j) * (s.v(j) - s.v(i)).dot(s.gradient(i, j));
    }
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (s.touches(i, w)) sum += std::sqrt(s.P(i, w)) * (s.v(i, w) - s.v(i)).dot(s.S(i, w));
    }
    rate[i] = -std::sqrt(s.P(i)) / s.rho(i) * sum;
  }
  return rate;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) <
             dense::round_off);
}

// Derived without the energy form's own equation: what the momentum form takes from the kinetic energy of a
// pair, half of it to each side.
BOOST_AUTO_TEST_CASE_TEMPLATE(two_particles_share_equally_what_their_kinetic_energy_loses, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = random_scene<Dim>(5, 2);
  auto const a = evaluate(scene, "momentum/sqrt-p", false).acceleration;
  auto const heating = evaluate(scene, id, false).heating;
  auto const& velocity = scene.particles.vector(Field::velocity);
  auto const& m = scene.particles.masses();
  double const lost = -(m[0] * velocity[0].dot(a[0]) + m[1] * velocity[1].dot(a[1]));
  BOOST_TEST(lost != 0.0);
  BOOST_TEST(m[0] * heating[0] == 0.5 * lost, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(m[1] * heating[1] == 0.5 * lost, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(power_of_a_wall_with_its_momentum_form_is_as_its_header_says, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = random_scene<Dim>(6, 30);
  auto const with = evaluate(scene, "momentum/sqrt-p").acceleration;
  auto const without = evaluate(scene, "momentum/sqrt-p", false).acceleration;
  auto const power = evaluate(scene, id).wall_power;
  dense::State<Dim> const s(scene);
  double found = power[0] + power[1];
  double expected = 0.0;
  for (std::size_t i = 0; i < s.particles(); ++i) {
    found += s.m(i) * s.v(i).dot(with[i] - without[i]);
    for (std::size_t w = 0; w < s.walls(); ++w) {
      if (!s.touches(i, w)) continue;
      expected -=
          s.m(i) * std::sqrt(s.P(i)) / s.rho(i) * std::sqrt(s.P(i, w)) * (s.v(i) + s.v(i, w)).dot(s.S(i, w));
    }
  }
  BOOST_TEST(found == expected, boost::test_tools::tolerance(1e-11));
}

// -P_B v_B.n per area, Eq. 40, where the gas beside the wall moves with it and many particles resolve the
// kernel.
BOOST_AUTO_TEST_CASE(power_of_a_wall_on_a_fine_lattice_is_pressure_times_velocity) {
  RandomScene<1> scene = lattice_scene<1>(400, 0.005, 20.0);
  scene.particles.scalar(Field::pressure).assign(400, 2.0);
  scene.particles.vector(Field::velocity).component(0).assign(400, -0.3);
  scene.walls.push_back({.point = Vector<1>(1.0), .outward_normal = Vector<1>(1.0)});
  scene.walls[0].pressure = [](Vector<1> const&, double) { return 2.0; };
  scene.walls[0].velocity = [](Vector<1> const&, double) { return Vector<1>(-0.3); };
  double const work_on_motion = evaluate(scene, "momentum/sqrt-p").wall_force[0][0] * -0.3;
  double const heating = evaluate(scene, id).wall_power[0];
  BOOST_TEST(work_on_motion + heating == 0.6, boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_SUITE_END()
