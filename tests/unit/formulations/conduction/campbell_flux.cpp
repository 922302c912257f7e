// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_conduction_campbell_flux)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "conduction/campbell-flux";

/// Eqs. 49, 81, 86 (with the index of F/rho put right).
template <int Dim>
std::vector<Vector<Dim>> flux_equation(dense::State<Dim> const& s, bool with_walls) {
  std::vector<Vector<Dim>> F(s.particles(), Vector<Dim>::Zero());
  for (std::size_t i = 0; i < s.particles(); ++i) {
    double const own = s.T(i) / (s.rho(i) * s.rho(i));
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (std::size_t j = 0; j < s.particles(); ++j) {
      sum += s.m(j) * (s.T(j) / (s.rho(j) * s.rho(j)) + own) * s.gradient(i, j);
    }
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (!s.touches(i, w)) continue;
      double const rho_B = s.rho(i, w);
      sum += (s.T(i, w) / (rho_B * rho_B) + own) * rho_B * s.S(i, w);
    }
    F[i] = -s.K(i) * s.rho(i) * sum;
  }
  return F;
}

/// Eqs. 47, 80, 85.
template <int Dim>
std::vector<double> equation(dense::State<Dim> const& s, bool with_walls) {
  auto const F = flux_equation(s, with_walls);
  std::vector<double> rate(s.particles(), 0.0);
  for (std::size_t i = 0; i < s.particles(); ++i) {
    Vector<Dim> const own = F[i] / (s.rho(i) * s.rho(i));
    for (std::size_t j = 0; j < s.particles(); ++j) {
      rate[i] -= s.m(j) * (F[j] / (s.rho(j) * s.rho(j)) + own).dot(s.gradient(i, j));
    }
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (!s.touches(i, w)) continue;
      double const rho_B = s.rho(i, w);
      rate[i] -= (s.F(i, w, F) / (rho_B * rho_B) + own).dot(s.S(i, w)) * rho_B;
    }
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

// With K(0) = 0 no particle has a flux, so that none reaches a wall that prescribes temperature: the Marshak
// wave never starts (equations.md). A one-sided closure starts it.
BOOST_AUTO_TEST_CASE(
    medium_that_does_not_conduct_takes_no_heat_from_a_hot_wall_unless_the_closure_is_one_sided) {
  RandomScene<1> scene = lattice_scene<1>(40, 0.05, 1.2);
  scene.walls.push_back({.point = Vector<1>(-1.0), .outward_normal = Vector<1>(-1.0)});
  scene.walls[0].temperature = [](Vector<1> const&, double) { return 1.0; };
  scene.walls[0].conductivity = [](Vector<1> const&, double) { return 1.0; };
  BOOST_TEST(largest(evaluate(scene, id).heating) == 0.0);
  scene.closure = Closure::one_sided;
  BOOST_TEST(evaluate(scene, id).heating[0] > 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
