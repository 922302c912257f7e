// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/neighbours/locality.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <numeric>

#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(formulations_neighbours_locality)

using namespace sphverify;
using namespace sphverify::tests;

using Order = std::vector<std::uint32_t>;

template <int Dim>
Domain<Dim> box() {
  return {.lower = Vector<Dim>::Constant(-0.5), .upper = Vector<Dim>::Constant(1.5)};
}

template <int Dim>
VectorField<Dim> random_positions(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  VectorField<Dim> positions(count);
  for (std::size_t i = 0; i < count; ++i) positions.set(i, random.vector<Dim>(-0.5, 1.5));
  return positions;
}

bool is_permutation(Order order) {
  Order counting(order.size());
  std::iota(counting.begin(), counting.end(), 0u);
  std::sort(order.begin(), order.end());
  return order == counting;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(every_particle_has_one_place, D, Dimensions) {
  constexpr int Dim = D::value;
  auto const positions = random_positions<Dim>(1000, 1);
  // Cells so small that their numbers do not fit, and so large that there is only one.
  for (double const cell : {1e-30, 0.1, 10.0}) {
    BOOST_TEST(is_permutation(locality_order(positions, box<Dim>(), cell)));
  }
  BOOST_TEST(locality_order(VectorField<Dim>(), box<Dim>(), 0.1).empty());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(who_is_near_in_space_is_mostly_near_in_memory, D, Dimensions) {
  constexpr int Dim = D::value;
  std::size_t const count = 4000;
  double const reach = 4.0 * std::pow(static_cast<double>(count), -1.0 / Dim);
  auto const positions = random_positions<Dim>(count, 2);
  Order const order = locality_order(positions, box<Dim>(), reach);
  Order place(count);
  for (std::uint32_t n = 0; n < count; ++n) place[order[n]] = n;
  CellGrid<Dim> const grid(positions, box<Dim>(), reach);
  double before = 0.0;
  double after = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    grid.for_each_within_reach(positions[i], [&](std::size_t j, Vector<Dim> const&, double) {
      before += std::abs(static_cast<double>(i) - static_cast<double>(j));
      after += std::abs(static_cast<double>(place[i]) - static_cast<double>(place[j]));
    });
  }
  BOOST_TEST_MESSAGE("mean distance in memory is " << after / before << " of a random order's");
  double const most[] = {0.01, 0.2, 0.5};
  BOOST_TEST(after < most[Dim - 1] * before);
}

BOOST_AUTO_TEST_CASE(cells_of_two_by_two_follow_each_other_as_a_z) {
  VectorField<2> positions(6);
  positions.set(0, {0.9, 0.9});
  positions.set(1, {0.9, 0.1});
  positions.set(2, {0.1, 0.9});
  positions.set(3, {0.1, 0.1});
  positions.set(4, {0.2, 0.0});
  positions.set(5, {0.0, 0.2});
  BOOST_TEST(locality_order(positions, box<2>(), 0.5) == (Order{3, 4, 5, 2, 1, 0}));  // 3, 4, 5 share a cell
}

BOOST_AUTO_TEST_CASE(cells_lie_along_the_axes_of_a_turned_box) {
  Domain<2> turned = box<2>();
  turned.axes = Random(4).rotation<2>();
  auto const positions = random_positions<2>(500, 3);
  auto there = positions;
  for (std::size_t i = 0; i < positions.size(); ++i) there.set(i, turned.to_space(positions[i]));
  BOOST_TEST(locality_order(there, turned, 0.07) == locality_order(positions, box<2>(), 0.07));
}

BOOST_AUTO_TEST_CASE(a_position_that_is_no_number_has_a_place_as_well) {
  auto positions = random_positions<2>(50, 3);
  positions.set(7, {std::numeric_limits<double>::quiet_NaN(), 0.3});
  positions.set(8, {0.1, std::numeric_limits<double>::infinity()});
  BOOST_TEST(is_permutation(locality_order(positions, box<2>(), 0.1)));
}

BOOST_AUTO_TEST_SUITE_END()
