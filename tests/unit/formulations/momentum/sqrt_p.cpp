// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_momentum_sqrt_p)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "momentum/sqrt-p";

/// Eq. 20.
template <int Dim>
std::vector<Vector<Dim>> equation(dense::State<Dim> const& s, bool with_walls) {
  std::vector<Vector<Dim>> a(s.particles(), Vector<Dim>::Zero());
  for (std::size_t i = 0; i < s.particles(); ++i) {
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (std::size_t j = 0; j < s.particles(); ++j) {
      sum += s.m(j) * std::sqrt(s.P(j)) / s.rho(j) * s.gradient(i, j);
    }
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (s.touches(i, w)) sum += std::sqrt(s.P(i, w)) * s.S(i, w);
    }
    a[i] = -2.0 * std::sqrt(s.P(i)) / s.rho(i) * sum;
  }
  return a;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) <
             dense::round_off);
}

BOOST_AUTO_TEST_CASE(vacuum_feels_no_force) {
  RandomScene<2> scene = random_scene<2>(1, 40);
  scene.particles.scalar(Field::pressure)[7] = 0.0;
  BOOST_TEST(evaluate(scene, id).acceleration[7].norm() == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
