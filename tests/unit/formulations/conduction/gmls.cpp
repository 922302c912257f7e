// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include <Eigen/LU>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_conduction_gmls)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "conduction/gmls";

/// Weights by normal equations, in long double: s = w P (P^T w P)^-1 e.
template <int Dim>
std::vector<double> equation(dense::State<Dim> const& s, bool with_walls) {
  constexpr int terms = Dim * (Dim + 3) / 2;
  using Row = Eigen::Matrix<long double, terms, 1>;
  std::vector<double> rate(s.particles(), 0.0);
  auto const row = [&](Vector<Dim> const& x) {
    Row p;
    int n = 0;
    for (int k = 0; k < Dim; ++k) p[n++] = static_cast<long double>(x[k] / s.h());
    for (int k = 0; k < Dim; ++k)
      for (int l = k; l < Dim; ++l) p[n++] = static_cast<long double>(x[k] * x[l] / (s.h() * s.h()));
    return p;
  };
  // h n.grad of the same
  auto const slope_row = [&](Vector<Dim> const& x, Vector<Dim> const& normal) {
    Row p;
    int n = 0;
    for (int k = 0; k < Dim; ++k) p[n++] = static_cast<long double>(normal[k]);
    for (int k = 0; k < Dim; ++k)
      for (int l = k; l < Dim; ++l) p[n++] = static_cast<long double>((normal[k] * x[l] + x[k] * normal[l]) / s.h());
    return p;
  };
  Row laplacian = Row::Zero();
  for (int k = 0, n = Dim; k < Dim; ++k)
    for (int l = k; l < Dim; ++l, ++n) laplacian[n] = k == l ? 2.0L : 0.0L;
  for (std::size_t i = 0; i < s.particles(); ++i) {
    struct Partner {
      Row p;
      double w, gain;  // of a weight 1/h^2
    };
    std::vector<Partner> partners;
    for (std::size_t j = 0; j < s.particles(); ++j) {
      Vector<Dim> const x = s.x(j) - s.x(i);
      if (j == i || x.norm() >= 2.0 * s.h()) continue;
      partners.push_back({row(x), dense::kernel<Dim>(x.norm(), s.h()), 0.5 * (s.K(i) + s.K(j)) * (s.T(j) - s.T(i))});
    }
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (!s.touches(i, w)) continue;
      Vector<Dim> const x = s.foot(i, w) - s.x(i);
      double const weight = dense::kernel<Dim>(x.norm(), s.h());
      if (s.flux_only(w)) {
        partners.push_back({slope_row(x, s.n(w)), weight, -s.h() * s.F(i, w, {}).dot(s.n(w))});
      } else {
        partners.push_back({row(x), weight, 0.5 * (s.K(i) + s.K(i, w)) * (s.T(i, w) - s.T(i))});
      }
    }
    Eigen::Matrix<long double, terms, terms> normal = Eigen::Matrix<long double, terms, terms>::Zero();
    for (Partner const& one : partners) normal += static_cast<long double>(one.w) * one.p * one.p.transpose();
    Row const c = normal.fullPivLu().solve(laplacian);
    long double sum = 0.0L;
    for (Partner const& one : partners) sum += static_cast<long double>(one.w * one.gain) * one.p.dot(c);
    rate[i] = static_cast<double>(sum) / (s.h() * s.h() * s.rho(i));
  }
  return rate;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_normal_equations_in_long_double, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) < 1e-8);
}

BOOST_AUTO_TEST_SUITE_END()
