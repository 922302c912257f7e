// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/evaluate/enclosure.hpp"

#include <boost/test/unit_test.hpp>

#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(harness_evaluate_enclosure)

using namespace sphverify;
using namespace sphverify::tests;

template <int Dim>
std::vector<Wall<Dim>> walls_of(std::vector<Vector<Dim>> const& normals) {
  std::vector<Wall<Dim>> walls;
  for (Vector<Dim> const& n : normals) walls.push_back({.point = n, .outward_normal = n.normalized()});
  return walls;
}

template <int Dim>
Domain<Dim> where_periodic(std::array<bool, Dim> const& axes) {
  return {-Vector<Dim>::Ones(), Vector<Dim>::Ones(), axes};
}

BOOST_AUTO_TEST_CASE(interval_closes_with_both_ends_or_none) {
  Vector<1> const right(1.0), left(-1.0);
  BOOST_TEST(!open_direction<1>(walls_of<1>({left, right}), where_periodic<1>({false})));
  BOOST_TEST(!open_direction<1>({}, where_periodic<1>({true})));
  BOOST_TEST(open_direction<1>(walls_of<1>({left}), where_periodic<1>({false})).value() == right);
  BOOST_TEST(open_direction<1>(walls_of<1>({right}), where_periodic<1>({false})).value() == left);
}

BOOST_AUTO_TEST_CASE(box_without_a_side_is_open_towards_it) {
  std::vector<Vector<3>> sides;
  for (int k = 0; k < 3; ++k) {
    sides.push_back(Vector<3>::Unit(k));
    sides.push_back(-Vector<3>::Unit(k));
  }
  BOOST_TEST(!open_direction<3>(walls_of<3>(sides), where_periodic<3>({})));
  for (std::size_t missing = 0; missing < sides.size(); ++missing) {
    std::vector<Vector<3>> rest = sides;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(missing));
    BOOST_TEST((open_direction<3>(walls_of<3>(rest), where_periodic<3>({})).value() - sides[missing]).norm() <
               1e-14);
  }
}

BOOST_AUTO_TEST_CASE(periodic_axes_close_what_walls_leave_open) {
  std::vector<Vector<2>> const faces{{1.0, 0.0}, {-1.0, 0.0}};
  BOOST_TEST(!open_direction<2>(walls_of<2>(faces), where_periodic<2>({false, true})));
  BOOST_TEST(std::abs(open_direction<2>(walls_of<2>(faces), where_periodic<2>({false, false})).value()[1]) ==
             1.0);
  std::vector<Vector<3>> const slanted{{1.0, 1.0, 0.0}, {-1.0, -1.0, 0.0}};
  BOOST_TEST(open_direction<3>(walls_of<3>(slanted), where_periodic<3>({false, false, true})).has_value());
  BOOST_TEST(!open_direction<3>(walls_of<3>(slanted), where_periodic<3>({false, true, true})));
}

// A closed set of walls has one before it in every direction.
BOOST_AUTO_TEST_CASE_TEMPLATE(answer_agrees_with_a_search_of_all_directions, D, Dimensions) {
  constexpr int Dim = D::value;
  Random random(5);
  int open = 0, closed = 0;
  for (int n = 0; n < 60; ++n) {
    std::vector<Vector<Dim>> normals;
    for (int w = 0; w < Dim + 1 + n % 4; ++w) normals.push_back(random.direction<Dim>());
    std::vector<Wall<Dim>> const walls = walls_of<Dim>(normals);
    auto const largest = [&](Vector<Dim> const& u) {
      double most = -1.0;
      for (Wall<Dim> const& wall : walls) most = std::max(most, wall.outward_normal.dot(u));
      return most;
    };
    auto const found = open_direction<Dim>(walls, where_periodic<Dim>({}));
    if (found) {
      ++open;
      BOOST_TEST(found->norm() == 1.0, boost::test_tools::tolerance(1e-12));
      BOOST_TEST(largest(*found) < 1e-8);
    } else {
      ++closed;
      for (int trial = 0; trial < 4000; ++trial) BOOST_TEST_REQUIRE(largest(random.direction<Dim>()) > 0.0);
    }
  }
  BOOST_TEST(open > 3);
  BOOST_TEST(closed > 3);
}

BOOST_AUTO_TEST_SUITE_END()
