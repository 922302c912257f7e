// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_conduction_lucy_flux)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "conduction/lucy-flux";

/// Eqs. 51 and 53, first line each, with Eq. 65.
template <int Dim>
std::vector<Vector<Dim>> flux_equation(dense::State<Dim> const& s, bool with_walls) {
  std::vector<Vector<Dim>> F(s.particles(), Vector<Dim>::Zero());
  for (std::size_t i = 0; i < s.particles(); ++i) {
    Vector<Dim> gradient = Vector<Dim>::Zero();
    for (std::size_t j = 0; j < s.particles(); ++j) gradient += s.m(j) / s.rho(j) * s.T(j) * s.gradient(i, j);
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (s.touches(i, w)) gradient += s.T(i, w) * s.S(i, w);
    }
    F[i] = -s.K(i) * gradient;
  }
  return F;
}

template <int Dim>
std::vector<double> equation(dense::State<Dim> const& s, bool with_walls) {
  auto const F = flux_equation(s, with_walls);
  std::vector<double> rate(s.particles(), 0.0);
  for (std::size_t i = 0; i < s.particles(); ++i) {
    double divergence = 0.0;
    for (std::size_t j = 0; j < s.particles(); ++j)
      divergence += s.m(j) / s.rho(j) * F[j].dot(s.gradient(i, j));
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (s.touches(i, w)) divergence += s.F(i, w, F).dot(s.S(i, w));
    }
    rate[i] = -divergence / s.rho(i);
  }
  return rate;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) <
             dense::round_off);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(leaves_its_flux_on_the_particles, D, Dimensions) {
  constexpr int Dim = D::value;
  dense::for_each_scene<Dim>([](RandomScene<Dim> const& scene, bool with_walls) {
    auto const expected = flux_equation(dense::State<Dim>(scene), with_walls);
    BOOST_TEST(relative_difference(evaluate(scene, id, with_walls).flux, expected) < dense::round_off);
  });
}

BOOST_AUTO_TEST_CASE(wall_delivers_half_of_a_prescribed_flux_on_a_fine_lattice) {
  RandomScene<1> scene = lattice_scene<1>(400, 0.005, 20.0);
  scene.particles.scalar(Field::temperature).assign(400, 1.0);
  scene.particles.scalar(Field::conductivity).assign(400, 1.0);
  scene.walls.push_back({.point = Vector<1>(-1.0), .outward_normal = Vector<1>(-1.0)});
  scene.walls[0].flux = [](Vector<1> const&, double) { return Vector<1>(0.7); };
  BOOST_TEST(evaluate(scene, id).wall_power[0] == 0.35, boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_SUITE_END()
