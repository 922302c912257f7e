// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_work_gdsph)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "work/gdsph";

template <int Dim>
std::vector<double> equation(dense::State<Dim> const& s, bool with_walls) {
  std::vector<double> rate(s.particles(), 0.0);
  for (std::size_t i = 0; i < s.particles(); ++i) {
    for (std::size_t j = 0; j < s.particles(); ++j)
      rate[i] += s.P(i) / s.rho(i) * s.m(j) / s.rho(j) * (s.v(i) - s.v(j)).dot(s.gradient(i, j));
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (s.touches(i, w)) rate[i] += 2.0 * s.P(i, w) / s.rho(i) * (s.v(i) - s.v(i, w)).dot(s.S(i, w));
    }
  }
  return rate;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  BOOST_TEST(dense::deviation<D::value>(id, [](auto const& s, bool walls) { return equation(s, walls); }) < dense::round_off);
}

/// Between walls that close in at its ends a gas that is compressed uniformly takes up P times the volume that is lost.
BOOST_AUTO_TEST_CASE(uniform_compression_does_the_work_of_the_volume_that_is_lost_up_to_the_walls) {
  RandomScene<1> scene = lattice_scene<1>(400, 0.005, 20.0);
  scene.particles.scalar(Field::pressure).assign(400, 2.0);
  for (std::size_t i = 0; i < 400; ++i) scene.particles.vector(Field::velocity).set(i, -0.3 * scene.particles.positions()[i]);
  for (double const side : {-1.0, 1.0}) {
    Wall<1> wall{.point = Vector<1>(side), .outward_normal = Vector<1>(side)};
    wall.velocity = [side](Vector<1> const&, double) { return Vector<1>(-0.3 * side); };
    wall.pressure = [](Vector<1> const&, double) { return 2.0; };
    scene.walls.push_back(wall);
  }
  auto const heating = evaluate(scene, id).heating;
  double power = 0.0;
  for (std::size_t i = 0; i < 400; ++i) power += scene.particles.masses()[i] * heating[i];
  BOOST_TEST(power == 2.0 * 0.3 * 2.0, boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_SUITE_END()
