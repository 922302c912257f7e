// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_work_internal_energy)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "work/internal-energy";

/// Eq. 42.
template <int Dim>
std::vector<double> equation(dense::State<Dim> const& s, bool with_walls) {
  std::vector<double> rate(s.particles(), 0.0);
  for (std::size_t i = 0; i < s.particles(); ++i) {
    for (std::size_t j = 0; j < s.particles(); ++j) {
      rate[i] -= s.m(j) * s.P(j) / (s.rho(j) * s.rho(j)) * (s.v(j) - s.v(i)).dot(s.gradient(i, j));
    }
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (s.touches(i, w)) rate[i] -= s.P(i, w) / s.rho(i, w) * (s.v(i, w) - s.v(i)).dot(s.S(i, w));
    }
  }
  return rate;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) <
             dense::round_off);
}

BOOST_AUTO_TEST_CASE(a_piston_that_advances_heats_the_gas_beside_it) {
  RandomScene<1> scene = lattice_scene<1>(20, 0.1, 1.2);
  scene.particles.scalar(Field::pressure).assign(20, 1.0);
  scene.walls.push_back({.point = Vector<1>(1.0), .outward_normal = Vector<1>(1.0)});
  scene.walls[0].velocity = [](Vector<1> const&, double) { return Vector<1>(-0.3); };
  auto const heating = evaluate(scene, id).heating;
  BOOST_TEST(heating[19] > 0.0);
  BOOST_TEST(heating[10] == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
