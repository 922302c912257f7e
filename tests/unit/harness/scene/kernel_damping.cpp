// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/scene/kernel_damping.hpp"

#include <boost/test/unit_test.hpp>

#include "formulations/kernels/kernel.hpp"

BOOST_AUTO_TEST_SUITE(harness_scene_kernel_damping)

using namespace sphverify;

double of(std::string_view id, int dimension) { return kernel_damping(kernel(id, dimension)); }

// By parts it is 2 pi h^2 W(0) in a plane.
BOOST_AUTO_TEST_CASE(in_a_plane_it_is_the_kernels_value_at_its_centre, *boost::unit_test::tolerance(1e-12)) {
  BOOST_TEST(of("cubic-spline", 2) == 20.0 / 7.0);
  BOOST_TEST(of("quintic-spline", 2) == 2.0 * 66.0 * 7.0 / 478.0);
  BOOST_TEST(of("wendland-c2", 2) == 3.5);
  BOOST_TEST(of("wendland-c4", 2) == 4.5);
  BOOST_TEST(of("wendland-c6", 2) == 39.0 / 7.0);
}

// And 4 pi h^2 int W dr in space.
BOOST_AUTO_TEST_CASE(in_space_it_is_the_kernels_integral_along_a_ray, *boost::unit_test::tolerance(1e-12)) {
  BOOST_TEST(of("cubic-spline", 3) == 3.0);
  BOOST_TEST(of("quintic-spline", 3) == 2.0);
  BOOST_TEST(of("wendland-c2", 3) == 3.5);
  BOOST_TEST(of("wendland-c4", 3) == 55.0 / 12.0);
  BOOST_TEST(of("wendland-c6", 3) == 91.0 / 16.0);
}

// Along a line by QUADPACK, from a thousandth of h on.
BOOST_AUTO_TEST_CASE(along_a_line_it_is_that_of_a_quadrature, *boost::unit_test::tolerance(2e-3)) {
  BOOST_TEST(of("cubic-spline", 1) == 2.768590);
  BOOST_TEST(of("quintic-spline", 1) == 1.868456);
  BOOST_TEST(of("wendland-c2", 1) == 2.496252);
  BOOST_TEST(of("wendland-c4", 1) == 3.494750);
  BOOST_TEST(of("wendland-c6", 1) == 4.575599);
}

BOOST_AUTO_TEST_SUITE_END()
