// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_momentum_pressure_energy)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "momentum/pressure-energy";

/// Pbar
template <int Dim>
std::vector<double> smoothed(dense::State<Dim> const& s, bool with_walls) {
  std::vector<double> sum(s.particles(), 0.0);
  for (std::size_t i = 0; i < s.particles(); ++i) {
    for (std::size_t j = 0; j < s.particles(); ++j) sum[i] += s.m(j) * s.P(j) / s.rho(j) * s.W(i, j);
    if (with_walls) sum[i] /= s.Gamma(i);
  }
  return sum;
}

template <int Dim>
std::vector<Vector<Dim>> equation(dense::State<Dim> const& s, bool with_walls) {
  std::vector<double> const smooth = smoothed(s, with_walls);
  auto const Y = [&](std::size_t i) { return s.m(i) * s.P(i) / s.rho(i); };
  std::vector<Vector<Dim>> a(s.particles(), Vector<Dim>::Zero());
  for (std::size_t i = 0; i < s.particles(); ++i) {
    for (std::size_t j = 0; j < s.particles(); ++j)
      a[i] -= Y(i) / s.m(i) * Y(j) * (1.0 / smooth[i] + 1.0 / smooth[j]) * s.gradient(i, j);
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (s.touches(i, w)) a[i] -= Y(i) / s.m(i) * (s.P(i, w) / smooth[i] + 1.0) * s.S(i, w);
    }
  }
  return a;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) < dense::round_off);
}

BOOST_AUTO_TEST_CASE(a_gas_without_pressure_is_not_pushed) {
  RandomScene<2> scene = random_scene<2>(3, 30);
  scene.particles.scalar(Field::pressure).assign(30, 0.0);
  BOOST_TEST(largest(evaluate(scene, id, false).acceleration) == 0.0);
  scene.walls[0].pressure = [](Vector<2> const&, double) { return 1e3; };
  BOOST_TEST(largest(evaluate(scene, id).acceleration) == 0.0);
}

/// Equal pressure, densities 1 and 8 by mass alone: where P/rho^2 with summed density has a tension, Y knows of no jump.
BOOST_AUTO_TEST_CASE(a_contact_between_masses_of_one_volume_is_at_rest) {
  RandomScene<1> scene = lattice_scene<1>(40, 0.1, 1.2);
  auto& p = scene.particles;
  p.scalar(Field::pressure).assign(40, 1.0);
  for (std::size_t i = 0; i < 40; ++i) p.masses()[i] = i < 20 ? 0.1 : 0.8;
  for (std::size_t i = 0; i < 40; ++i) p.scalar(Field::density)[i] = 10.0 * p.masses()[i];
  auto const a = evaluate(scene, id).acceleration;
  for (std::size_t i = 10; i < 30; ++i) BOOST_TEST(std::abs(a[i][0]) < 1e-13);
}

BOOST_AUTO_TEST_SUITE_END()
