// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_momentum_direct_gradient)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "momentum/direct-gradient";

/// Eqs. 7 (first form), 65.
template <int Dim>
std::vector<Vector<Dim>> equation(dense::State<Dim> const& s, bool with_walls) {
  std::vector<Vector<Dim>> a(s.particles(), Vector<Dim>::Zero());
  for (std::size_t i = 0; i < s.particles(); ++i) {
    Vector<Dim> gradient = Vector<Dim>::Zero();
    for (std::size_t j = 0; j < s.particles(); ++j) gradient += s.m(j) * s.P(j) / s.rho(j) * s.gradient(i, j);
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (s.touches(i, w)) gradient += s.P(i, w) * s.S(i, w);
    }
    a[i] = -gradient / s.rho(i);
  }
  return a;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) <
             dense::round_off);
}

BOOST_AUTO_TEST_CASE(neighbour_of_a_particle_without_pressure_does_not_feel_it) {
  RandomScene<2> scene = random_scene<2>(1, 40);
  auto const with = evaluate(scene, id);
  scene.particles.scalar(Field::pressure)[7] *= 3.0;
  auto const changed = evaluate(scene, id, true);
  BOOST_TEST((with.acceleration[7] - changed.acceleration[7]).norm() ==
             0.0);  // its own pressure is not in its sum
  BOOST_TEST(relative_difference(changed.acceleration, with.acceleration) > 1e-3);
}

BOOST_AUTO_TEST_SUITE_END()
