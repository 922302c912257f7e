// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include <Eigen/LU>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_work_rkgc)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "work/rkgc";

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
std::vector<double> equation(dense::State<Dim> const& s, bool with_walls) {
  Corrected<Dim> const c(s, with_walls);
  std::vector<double> rate(s.particles(), 0.0);
  for (std::size_t i = 0; i < s.particles(); ++i) {
    for (std::size_t j = 0; j < s.particles(); ++j)
      rate[i] += s.P(i) / s.rho(i) * s.m(j) / s.rho(j) * (s.v(i) - s.v(j)).dot(c.L[j] * s.gradient(i, j));
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (s.touches(i, w)) rate[i] += s.P(i, w) / s.rho(i) * c.sigma[i].dot(s.n(w)) * (s.v(i) - s.v(i, w)).dot(s.n(w));
    }
  }
  return rate;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) < dense::round_off);
}

BOOST_AUTO_TEST_SUITE_END()
