// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/support/boxes.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

BOOST_AUTO_TEST_SUITE(cases_support_boxes)

using namespace sphverify;

template <int Dim>
void check_wall(Wall<Dim> const& wall, Vector<Dim> const& normal, double distance_of_the_origin) {
  BOOST_TEST((wall.outward_normal - normal).norm() < 1e-15);
  BOOST_TEST(std::abs(wall.distance(Vector<Dim>::Zero()) - distance_of_the_origin) < 1e-15);
  BOOST_TEST((!wall.pressure && !wall.velocity && !wall.temperature && !wall.conductivity && !wall.flux));
}

BOOST_AUTO_TEST_CASE(a_slab_has_walls_across_its_first_axis_and_a_period_along_the_others) {
  Domain<3> const domain = slab<3>(-1.0, 2.0, 0.25);
  BOOST_TEST((domain.extent() - Vector<3>(3.0, 0.25, 0.25)).norm() == 0.0);
  BOOST_TEST((!domain.periodic[0] && domain.periodic[1] && domain.periodic[2]));
  BOOST_TEST((slab<2>(-1.0, 2.0).extent() - Vector<2>(3.0, 3.0)).norm() == 0.0);
  for (auto const& walls : {slab_walls(domain), box_walls(domain)}) {
    BOOST_TEST_REQUIRE(walls.size() == 2u);
    check_wall<3>(walls[0], -Vector<3>::UnitX(), 1.0);
    check_wall<3>(walls[1], Vector<3>::UnitX(), 2.0);
  }
}

BOOST_AUTO_TEST_CASE(a_box_has_walls_on_all_sides_axis_by_axis_lower_then_upper) {
  Domain<3> const domain{Vector<3>(-1.0, -2.0, -3.0), Vector<3>(4.0, 5.0, 6.0), {}};
  auto const walls = box_walls(domain);
  BOOST_TEST_REQUIRE(walls.size() == 6u);
  for (int k = 0; k < 3; ++k) {
    std::size_t const lower = 2 * static_cast<std::size_t>(k);
    check_wall<3>(walls[lower], -Vector<3>::Unit(k), 1.0 + k);
    check_wall<3>(walls[lower + 1], Vector<3>::Unit(k), 4.0 + k);
  }
  BOOST_TEST(box_walls(unit_box<1>()).size() == 2u);
  BOOST_TEST(box_walls(unit_box<2>()).size() == 4u);
  BOOST_TEST((unit_box<2>().extent() - Vector<2>(1.0, 1.0)).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(periodic_sides_have_no_walls) {
  Domain<2> domain = unit_box<2>();
  domain.periodic = {true, false};
  auto const walls = box_walls(domain);
  BOOST_TEST_REQUIRE(walls.size() == 2u);
  check_wall<2>(walls[0], -Vector<2>::UnitY(), 0.0);
  check_wall<2>(walls[1], Vector<2>::UnitY(), 1.0);
  domain.periodic = {true, true};
  BOOST_TEST(box_walls(domain).empty());
}

BOOST_AUTO_TEST_CASE(walls_of_a_turned_box_stand_on_its_own_sides) {
  Domain<2> domain{Vector<2>(-1.0, -2.0), Vector<2>(3.0, 4.0), {}};
  domain.axes << 0.6, -0.8, 0.8, 0.6;
  auto const walls = box_walls(domain);
  BOOST_TEST_REQUIRE(walls.size() == 4u);
  check_wall<2>(walls[0], Vector<2>(-0.6, -0.8), 1.0);
  check_wall<2>(walls[1], Vector<2>(0.6, 0.8), 3.0);
  check_wall<2>(walls[2], Vector<2>(0.8, -0.6), 2.0);
  check_wall<2>(walls[3], Vector<2>(-0.8, 0.6), 4.0);
  BOOST_TEST((slab_walls(domain)[1].point - walls[1].point).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(an_infinite_value_along_the_first_axis_leaves_zero_along_the_others) {
  Vector<3> const v = along_first_axis<3>(-std::numeric_limits<double>::infinity());
  BOOST_TEST(v[0] == -std::numeric_limits<double>::infinity());
  BOOST_TEST((v[1] == 0.0 && v[2] == 0.0));
}

BOOST_AUTO_TEST_SUITE_END()
