// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_conduction_gamma_brookshaw)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "conduction/gamma-brookshaw";

template <int Dim>
double gamma(dense::State<Dim> const& s, std::size_t i) {
  double sum = 0.0;
  for (std::size_t j = 0; j < s.particles(); ++j)
    sum += s.m(j) / s.rho(j) * dense::kernel<Dim>((s.x(i) - s.x(j)).norm(), s.h());
  return sum;
}

template <int Dim>
std::vector<double> equation(dense::State<Dim> const& s, bool with_walls) {
  std::vector<double> rate = dense::difference_form(s, with_walls, dense::arithmetic);
  for (std::size_t i = 0; i < rate.size(); ++i) rate[i] /= gamma(s, i);
  return rate;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) <
             dense::round_off);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(pairs_conserve_energy_weighed_with_gamma_and_no_other, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = random_scene<Dim>(5, 50);
  dense::State<Dim> const s(scene);
  auto const heating = evaluate(scene, id, false).heating;
  double weighed = 0.0, plain = 0.0, gross = 0.0;
  for (std::size_t i = 0; i < heating.size(); ++i) {
    weighed += gamma(s, i) * s.m(i) * heating[i];
    plain += s.m(i) * heating[i];
    gross += s.m(i) * std::abs(heating[i]);
  }
  BOOST_TEST(std::abs(weighed) < 1e-12 * gross);
  BOOST_TEST(std::abs(plain) > 1e-3 * gross);
}

BOOST_AUTO_TEST_SUITE_END()
