// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "formulations/conduction/conductivity_mean.hpp"
#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_conduction_cleary_monaghan)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "conduction/cleary-monaghan";

double in_series(double a, double b) { return 1.0 / (0.5 / a + 0.5 / b); }

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return dense::difference_form(s, walls, in_series); }) <
             dense::round_off);
}

BOOST_AUTO_TEST_CASE(harmonic_mean_is_that_of_resistances_in_series_and_zero_where_one_does_not_conduct) {
  BOOST_TEST(harmonic_mean(1.0, 3.0) == 1.5);
  BOOST_TEST(harmonic_mean(2.0, 0.0) == 0.0);
  BOOST_TEST(harmonic_mean(0.0, 0.0) == 0.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_does_not_conduct_exchanges_nothing, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = random_scene<Dim>(2, 40);
  auto& K = scene.particles.scalar(Field::conductivity);
  for (std::size_t i = 0; i < K.size(); i += 2) K[i] = 0.0;
  auto const heating = evaluate(scene, id).heating;
  BOOST_TEST(std::isfinite(largest(heating)));
  for (std::size_t i = 0; i < K.size(); i += 2) BOOST_TEST(heating[i] == 0.0);
  BOOST_TEST(largest(heating) > 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
