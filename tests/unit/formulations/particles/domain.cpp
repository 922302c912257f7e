// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/particles/domain.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(formulations_particles_domain)

using namespace sphverify;

Domain<2> box(bool first, bool second) {
  return {.lower = {-1.0, 2.0}, .upper = {3.0, 4.0}, .periodic = {first, second}};
}

BOOST_AUTO_TEST_CASE(nearest_image_is_at_most_half_a_period_away_along_periodic_axes) {
  BOOST_TEST((box(true, true).nearest_image({3.5, -1.9}) - Vector<2>(-0.5, 0.1)).norm() < 1e-15);
  BOOST_TEST((box(true, true).nearest_image({-2.5, 0.9}) - Vector<2>(1.5, 0.9)).norm() < 1e-15);
}

BOOST_AUTO_TEST_CASE(separations_along_other_axes_are_left_alone) {
  BOOST_TEST((box(false, true).nearest_image({3.5, -1.9}) - Vector<2>(3.5, 0.1)).norm() < 1e-15);
  BOOST_TEST((box(false, false).nearest_image({3.5, -1.9}) - Vector<2>(3.5, -1.9)).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(knows_its_extent_and_whether_any_axis_is_periodic) {
  BOOST_TEST((box(false, false).extent() - Vector<2>(4.0, 2.0)).norm() == 0.0);
  BOOST_TEST(box(false, true).is_periodic());
  BOOST_TEST(!box(false, false).is_periodic());
}

BOOST_AUTO_TEST_SUITE_END()
