#include <boost/test/unit_test.hpp>

#include "formulations/conduction/conductivity_mean.hpp"
#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_conduction_cleary_monaghan)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "conduction/cleary-monaghan";

double in_series(double a, double b) { return 1.0 / (0.5 / a + 0.5 / b); }

template <int Dim>
std::vector<double> equation(dense::State<Dim> const& s, bool with_walls) {
  std::vector<double> rate(s.particles(), 0.0);
  for (std::size_t i = 0; i < s.particles(); ++i) {
    for (std::size_t j = 0; j < s.particles(); ++j) {
      if (j == i) continue;
      Vector<Dim> const r = s.x(i) - s.x(j);
      rate[i] += s.m(j) * 2.0 * in_series(s.K(i), s.K(j)) / (s.rho(i) * s.rho(j)) * (s.T(i) - s.T(j)) *
                 r.dot(s.gradient(i, j)) / r.squaredNorm();
    }
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (!s.touches(i, w)) continue;
      if (s.flux_only(w)) {
        rate[i] -= 2.0 * s.F(i, w, {}).dot(s.S(i, w)) / s.rho(i);
      } else {
        rate[i] += 2.0 * in_series(s.K(i), s.K(i, w)) / s.rho(i) * (s.T(i, w) - s.T(i)) / s.d(i, w) * s.A(i, w);
      }
    }
  }
  return rate;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) <
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
