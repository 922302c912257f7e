// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include <Eigen/LU>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_momentum_rkgc)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "momentum/rkgc";

template <int Dim>
struct Corrected {
  std::vector<Matrix<Dim>> L;
  std::vector<Vector<Dim>> sigma;

  Corrected(dense::State<Dim> const& s, bool with_walls)
      : L(s.particles(), Matrix<Dim>::Zero()), sigma(s.particles(), Vector<Dim>::Zero()) {
    for (std::size_t i = 0; i < s.particles(); ++i) {
      for (std::size_t j = 0; j < s.particles(); ++j)
        L[i] += s.m(j) / s.rho(j) * (s.x(j) - s.x(i)) * s.gradient(i, j).transpose();
      for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
        if (s.touches(i, w)) L[i] += s.d(i, w) * s.n(w) * s.S(i, w).transpose();
      }
      if (with_walls) L[i] /= s.Gamma(i);
      L[i] = L[i].inverse().eval();
    }
    for (std::size_t i = 0; i < s.particles(); ++i) {
      for (std::size_t j = 0; j < s.particles(); ++j) sigma[i] -= s.m(j) / s.rho(j) * (L[i] + L[j]) * s.gradient(i, j);
    }
  }
};

template <int Dim>
std::vector<Vector<Dim>> equation(dense::State<Dim> const& s, bool with_walls) {
  Corrected<Dim> const c(s, with_walls);
  std::vector<Vector<Dim>> a(s.particles(), Vector<Dim>::Zero());
  for (std::size_t i = 0; i < s.particles(); ++i) {
    for (std::size_t j = 0; j < s.particles(); ++j)
      a[i] -= s.m(j) / s.rho(j) * (s.P(i) * c.L[j] + s.P(j) * c.L[i]) * s.gradient(i, j);
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (s.touches(i, w)) a[i] -= s.P(i, w) * c.sigma[i].dot(s.n(w)) * s.n(w);
    }
    a[i] /= s.rho(i);
  }
  return a;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) < dense::round_off);
}

/// Particles that jitter by 0.3 of a spacing in a box of walls that prescribe a pressure.
template <int Dim>
RandomScene<Dim> box(int side) {
  RandomScene<Dim> scene = lattice_scene<Dim>(side, 1.0 / side, 1.3);
  Random random(4);
  for (std::size_t i = 0; i < scene.particles.size(); ++i)
    scene.particles.positions().add(i, 0.3 / side * random.vector<Dim>(-1.0, 1.0));
  scene.particles.scalar(Field::pressure).assign(scene.particles.size(), 1.7);
  for (int k = 0; k < 2 * Dim; ++k) {
    Wall<Dim> wall;
    wall.outward_normal = (k % 2 == 0 ? 1.0 : -1.0) * Vector<Dim>::Unit(k / 2);
    wall.point = 0.5 * wall.outward_normal;
    wall.pressure = [](Vector<Dim> const&, double) { return 1.7; };
    scene.walls.push_back(wall);
  }
  return scene;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(uniform_gas_feels_nothing_along_a_wall_s_normal_on_disorder, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = box<Dim>(12);
  auto const a = evaluate(scene, id, geometry_of(scene)).acceleration;
  double const reach = 2.0 * scene.particles.smoothing_length();
  double along = 0.0, elsewhere = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int k = 0; k < Dim; ++k) {
      bool const is_near = 0.5 - std::abs(scene.particles.positions()[i][k]) < reach;
      double& most = is_near ? along : elsewhere;
      most = std::max(most, std::abs(a[i][k]));
    }
  }
  BOOST_TEST(along < 1e-11);
  BOOST_TEST(elsewhere > 1e-2);
}

BOOST_AUTO_TEST_SUITE_END()
