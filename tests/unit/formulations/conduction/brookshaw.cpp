// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_conduction_brookshaw)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "conduction/brookshaw";

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return dense::difference_form(s, walls, dense::arithmetic); }) <
             dense::round_off);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(insulated_wall_gives_nothing, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = random_scene<Dim>(2, 40, {}, {});
  for (Wall<Dim>& wall : scene.walls) {
    wall.flux = [](Vector<Dim> const&, double) -> Vector<Dim> { return Vector<Dim>::Zero(); };
  }
  auto const rates = evaluate(scene, id);
  BOOST_TEST(same_bits(rates.heating, evaluate(scene, id, false).heating));
  BOOST_TEST(rates.wall_power[0] == 0.0);
}

BOOST_AUTO_TEST_CASE(prescribed_flux_enters_whole_on_a_fine_lattice) {
  RandomScene<1> scene = lattice_scene<1>(400, 0.005, 20.0);
  scene.particles.scalar(Field::temperature).assign(400, 1.0);
  scene.particles.scalar(Field::conductivity).assign(400, 1.0);
  scene.walls.push_back({.point = Vector<1>(-1.0), .outward_normal = Vector<1>(-1.0)});
  scene.walls[0].flux = [](Vector<1> const&, double) { return Vector<1>(0.7); };  // into the fluid
  BOOST_TEST(evaluate(scene, id).wall_power[0] == 0.7, boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(heat_flows_from_hot_to_cold_in_every_pair, D, Dimensions) {
  constexpr int Dim = D::value;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomScene<Dim> const scene = random_scene<Dim>(seed, 2);
    auto const& T = scene.particles.scalar(Field::temperature);
    BOOST_TEST(evaluate(scene, id, false).heating[0] * (T[1] - T[0]) >= 0.0);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(uniform_temperature_is_exactly_steady_on_disorder, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = random_scene<Dim>(3, 40, {}, {});
  scene.particles.scalar(Field::temperature).assign(40, 1.7);
  for (Wall<Dim>& wall : scene.walls) {
    wall.temperature = [](Vector<Dim> const&, double) { return 1.7; };
    wall.conductivity = [](Vector<Dim> const&, double) { return 0.9; };
  }
  BOOST_TEST(largest(evaluate(scene, id).heating) == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
