// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/walls/wall_out_of_reach.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

BOOST_AUTO_TEST_SUITE(formulations_walls_wall_out_of_reach)

using namespace sphverify;
using boost::test_tools::tolerance;

constexpr double h = 0.1;

/// Gas with a slope in everything, its last particle a little within, or beyond, reach of a wall at 0.
Particles<1> gas(double nearest) {
  Particles<1> particles(3, h);
  particles.allocate({Field::density, Field::velocity, Field::pressure});
  for (std::size_t i = 0; i < 3; ++i) {
    auto const k = static_cast<double>(i);
    particles.positions().set(i, Vector<1>(-nearest - 0.05 * k));
    particles.masses()[i] = 0.05 * (1.0 + k);
    particles.scalar(Field::density)[i] = 1.0 + k;
    particles.scalar(Field::pressure)[i] = 0.6 - 0.1 * k;
    particles.vector(Field::velocity).set(i, Vector<1>(0.4 - 0.1 * k));
  }
  return particles;
}

// By its definition: no jump as the last particle leaves.
BOOST_AUTO_TEST_CASE(it_is_what_the_closure_says_as_the_last_particle_leaves) {
  Wall<1> wall{.point = Vector<1>(0.0), .outward_normal = Vector<1>(1.0)};
  wall.gamma = 5.0 / 3.0;
  for (double const P_B : {0.0, 0.3, 2.0}) {
    wall.pressure = [P_B](Vector<1> const&, double) { return P_B; };
    std::vector<Wall<1>> const walls{wall};
    for (Closure const closure : {Closure::interpolated, Closure::quotient, Closure::one_sided}) {
      Particles<1> const inside = gas(2.0 * h * (1.0 - 1e-6));
      CellGrid<1> const grid(inside.positions(), {Vector<1>(-1.0), Vector<1>(0.0), {false}}, 2.0 * h);
      WallContacts<1> contacts =
          find_wall_contacts(grid, walls[0], walls, SmoothingLength(inside), inside.masses(),
                             inside.scalar(Field::density), FaceWeight::exact);
      BOOST_TEST_REQUIRE(contacts.size() == 1u);
      fill_boundary_values(contacts, walls[0], inside, {BoundaryValue::velocity}, closure, 0.0);
      Vector<1> const outside = velocity_out_of_reach(walls[0], gas(2.0 * h * (1.0 + 1e-6)), closure, 0.0);
      BOOST_TEST(std::abs(contacts.velocity[0][0] - outside[0]) < 1e-12);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_wall_without_pressure_runs_ahead_at_the_speed_of_escape) {
  Wall<1> wall{.point = Vector<1>(0.0), .outward_normal = Vector<1>(1.0)};
  wall.gamma = 5.0 / 3.0;
  wall.pressure = [](Vector<1> const&, double) { return 0.0; };
  // v + 2 c/(gamma - 1) with c = 1.
  BOOST_TEST(velocity_out_of_reach(wall, gas(0.3), Closure::one_sided, 0.0)[0] == 3.4, tolerance(1e-14));
}

BOOST_AUTO_TEST_SUITE_END()
