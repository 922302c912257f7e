// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/wall_facts.hpp"

#include <boost/test/unit_test.hpp>

#include "cases/support/case.hpp"
#include "harness/scene/wall_geometry.hpp"

BOOST_AUTO_TEST_SUITE(harness_study_wall_facts)

using namespace sphverify;

BOOST_AUTO_TEST_CASE(a_side_without_wall_or_image_is_free_and_named) {
  Case const* const square = find_case("conduction/square");
  auto problem = std::get<Problem<2>>(square->problem(Parameters(square->info.parameters)));
  BOOST_TEST(is_closed(AnyProblem(problem)));
  BOOST_TEST(!free_side(problem).has_value());
  problem.walls.pop_back();
  BOOST_TEST(!is_closed(AnyProblem(problem)));
  BOOST_TEST(free_side(problem).value() == "the upper side of axis 2");
  problem.domain.periodic[1] = true;
  BOOST_TEST(is_closed(AnyProblem(problem)));
}

BOOST_AUTO_TEST_SUITE_END()
