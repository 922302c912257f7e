// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_work_pressure_energy)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "work/pressure-energy";

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
std::vector<double> equation(dense::State<Dim> const& s, bool with_walls) {
  std::vector<double> const smooth = smoothed(s, with_walls);
  auto const Y = [&](std::size_t i) { return s.m(i) * s.P(i) / s.rho(i); };
  std::vector<double> rate(s.particles(), 0.0);
  for (std::size_t i = 0; i < s.particles(); ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < s.particles(); ++j) sum += Y(j) * (s.v(i) - s.v(j)).dot(s.gradient(i, j));
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (s.touches(i, w)) sum += s.P(i, w) * (s.v(i) - s.v(i, w)).dot(s.S(i, w));
    }
    rate[i] = Y(i) / s.m(i) / smooth[i] * sum;
  }
  return rate;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) < dense::round_off);
}

BOOST_AUTO_TEST_SUITE_END()
