// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_work_total_energy)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "work/total-energy";

/// Eqs. 37, 78, 84.
template <int Dim>
std::vector<double> equation(dense::State<Dim> const& s, bool with_walls) {
  std::vector<double> rate(s.particles(), 0.0);
  for (std::size_t i = 0; i < s.particles(); ++i) {
    Vector<Dim> const own = s.P(i) / (s.rho(i) * s.rho(i)) * s.v(i);
    for (std::size_t j = 0; j < s.particles(); ++j) {
      rate[i] -= s.m(j) * (s.P(j) / (s.rho(j) * s.rho(j)) * s.v(j) + own).dot(s.gradient(i, j));
    }
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (!s.touches(i, w)) continue;
      double const rho_B = s.rho(i, w);
      rate[i] -= rho_B * (s.P(i, w) / (rho_B * rho_B) * s.v(i, w) + own).dot(s.S(i, w));
    }
  }
  return rate;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) <
             dense::round_off);
}

BOOST_AUTO_TEST_CASE(fluid_and_wall_at_rest_do_no_work) {
  RandomScene<2> scene = random_scene<2>(1, 40);
  scene.particles.vector(Field::velocity) = VectorField<2>(40);
  for (Wall<2>& wall : scene.walls) {
    wall.velocity = [](Vector<2> const&, double) -> Vector<2> { return Vector<2>::Zero(); };
  }
  BOOST_TEST(largest(evaluate(scene, id).heating) == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
