// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_momentum_p_rho2)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "momentum/p-rho2";

/// Eqs. 11, 68, 82.
template <int Dim>
std::vector<Vector<Dim>> equation(dense::State<Dim> const& s, bool with_walls) {
  std::vector<Vector<Dim>> a(s.particles(), Vector<Dim>::Zero());
  for (std::size_t i = 0; i < s.particles(); ++i) {
    double const own = s.P(i) / (s.rho(i) * s.rho(i));
    for (std::size_t j = 0; j < s.particles(); ++j) {
      a[i] -= s.m(j) * (s.P(j) / (s.rho(j) * s.rho(j)) + own) * s.gradient(i, j);
    }
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (!s.touches(i, w)) continue;
      double const rho_B = s.rho(i, w);
      a[i] -= (s.P(i, w) / (rho_B * rho_B) + own) * rho_B * s.S(i, w);
    }
  }
  return a;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) <
             dense::round_off);
}

// The residual of a uniform gas at a wall, as a fraction of P/(rho dx): 6% at h/dx = 1.2 in 1D.
BOOST_AUTO_TEST_CASE(uniform_gas_is_not_at_rest_at_a_wall_but_tends_to_rest_as_h_over_dx_grows) {
  auto const residual = [](double smoothing_ratio) {
    RandomScene<1> scene = lattice_scene<1>(200, 0.01, smoothing_ratio);
    scene.particles.scalar(Field::pressure).assign(200, 1.0);
    scene.walls.push_back({.point = Vector<1>(-1.0), .outward_normal = Vector<1>(-1.0)});
    scene.walls[0].pressure = [](Vector<1> const&, double) { return 1.0; };
    return largest(std::vector<Vector<1>>{evaluate(scene, id).acceleration[0]}) * 0.01;
  };
  BOOST_TEST_MESSAGE("residual at h/dx = 1.2: " << residual(1.2) << ", 2.4: " << residual(2.4)
                                                << ", 9.6: " << residual(9.6));
  BOOST_TEST(std::abs(residual(1.2) - 0.06) < 0.005);
  BOOST_TEST(residual(9.6) < 0.1 * residual(1.2));
}

BOOST_AUTO_TEST_SUITE_END()
