// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_momentum_gdsph)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "momentum/gdsph";

template <int Dim>
std::vector<Vector<Dim>> equation(dense::State<Dim> const& s, bool with_walls) {
  std::vector<Vector<Dim>> a(s.particles(), Vector<Dim>::Zero());
  for (std::size_t i = 0; i < s.particles(); ++i) {
    for (std::size_t j = 0; j < s.particles(); ++j)
      a[i] -= s.m(j) * (s.P(i) + s.P(j)) / (s.rho(i) * s.rho(j)) * s.gradient(i, j);
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (s.touches(i, w)) a[i] -= 2.0 * s.P(i, w) * s.S(i, w) / s.rho(i);
    }
  }
  return a;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) < dense::round_off);
}

/// As h/dx grows the sum over particles of the kernel's part beyond the wall becomes its integral, 1/2 an area.
BOOST_AUTO_TEST_CASE(a_wall_gives_the_impulse_that_it_prescribes_whatever_the_gas_s_own_pressure) {
  RandomScene<1> scene = lattice_scene<1>(400, 0.005, 20.0);
  scene.particles.scalar(Field::pressure).assign(400, 7.0);
  scene.walls.push_back({.point = Vector<1>(1.0), .outward_normal = Vector<1>(1.0)});
  scene.walls[0].pressure = [](Vector<1> const&, double) { return 2.0; };
  BOOST_TEST(evaluate(scene, id).wall_force[0][0] == -2.0, boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_SUITE_END()
