// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include <Eigen/LU>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_conduction_corrected_flux)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "conduction/corrected-flux";

template <int Dim>
std::vector<double> equation(dense::State<Dim> const& s, bool with_walls) {
  std::size_t const n = s.particles();
  std::vector<Matrix<Dim>> L(n);
  std::vector<Vector<Dim>> F(n, Vector<Dim>::Zero());
  auto const for_walls = [&](std::size_t i, auto const& act) {
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (s.touches(i, w)) act(w);
    }
  };
  for (std::size_t i = 0; i < n; ++i) {
    Matrix<Dim> inverse = Matrix<Dim>::Zero();
    Vector<Dim> gradient = Vector<Dim>::Zero();
    for (std::size_t j = 0; j < n; ++j) {
      inverse += s.m(j) / s.rho(j) * (s.x(j) - s.x(i)) * s.gradient(i, j).transpose();
      gradient += s.m(j) / s.rho(j) * (s.T(j) - s.T(i)) * s.gradient(i, j);
    }
    for_walls(i, [&](std::size_t w) {
      inverse += s.d(i, w) * s.n(w) * s.S(i, w).transpose();
      gradient += (s.T(i, w) - s.T(i)) * s.S(i, w);
    });
    L[i] = inverse.inverse();
    F[i] = -s.K(i) * L[i] * gradient;
  }
  std::vector<double> rate(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) rate[i] -= s.m(j) / s.rho(j) * (F[j] - F[i]).dot(L[i] * s.gradient(i, j));
    for_walls(i, [&](std::size_t w) { rate[i] -= (s.F(i, w, F) - F[i]).dot(L[i] * s.S(i, w)); });
    rate[i] /= s.rho(i);
  }
  return rate;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) <
             dense::round_off);
}

/// Particles that jitter by 0.4 of a spacing between walls on all sides.
BOOST_AUTO_TEST_CASE_TEMPLATE(linear_temperature_has_its_flux_on_disorder_and_into_corners, D, Dimensions) {
  constexpr int Dim = D::value;
  int const side = Dim == 3 ? 8 : 12;
  RandomScene<Dim> scene = lattice_scene<Dim>(side, 1.0 / side, 1.3);
  Random random(4);
  auto& T = scene.particles.scalar(Field::temperature);
  Vector<Dim> const slope = random.vector<Dim>(0.5, 2.0);
  for (std::size_t i = 0; i < T.size(); ++i) {
    scene.particles.positions().add(i, 0.4 / side * random.vector<Dim>(-1.0, 1.0));
    T[i] = 3.0 + slope.dot(scene.particles.positions()[i]);
  }
  scene.particles.scalar(Field::conductivity).assign(T.size(), 0.7);
  for (int k = 0; k < 2 * Dim; ++k) {
    Wall<Dim> wall;
    wall.outward_normal = (k % 2 == 0 ? 1.0 : -1.0) * Vector<Dim>::Unit(k / 2);
    wall.point = 0.5 * wall.outward_normal;
    wall.temperature = [slope](Vector<Dim> const& foot, double) { return 3.0 + slope.dot(foot); };
    wall.conductivity = [](Vector<Dim> const&, double) { return 0.7; };
    scene.walls.push_back(wall);
  }
  scene.closure = Closure::one_sided;
  auto const flux = evaluate(scene, id, geometry_of(scene)).flux;
  double worst = 0.0;
  for (Vector<Dim> const& F : flux) worst = std::max(worst, (F + 0.7 * slope).norm());
  BOOST_TEST(worst < 1e-11);
}

BOOST_AUTO_TEST_CASE(neighbours_in_one_direction_are_refused_by_name) {
  RandomScene<2> scene = lattice_scene<2>(6, 0.1, 1.3);
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    Vector<2> x = scene.particles.positions()[i];
    x[1] *= 100.0;  // rows that see nothing of each other
    scene.particles.positions().set(i, x);
  }
  scene.domain.lower[1] *= 100.0;
  scene.domain.upper[1] *= 100.0;
  BOOST_CHECK_EXCEPTION(evaluate(scene, id, geometry_of(scene)), TooFewPartners, [](TooFewPartners const& error) {
    return std::string(error.what()) == "particle 0: its neighbours do not span space: take a larger h/dx";
  });
}

BOOST_AUTO_TEST_SUITE_END()
