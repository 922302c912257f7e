// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <numeric>

#include "formulations/layouts/layout.hpp"
#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(formulations_layouts_layout_clumped)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

/// Cells of 0.25 along every axis at resolution 8, 0.4 at 5.
template <int Dim>
Domain<Dim> box() {
  return {.lower = Vector<Dim>::Constant(-0.5), .upper = Vector<Dim>::Constant(1.5)};
}

template <int Dim>
double total(Layout<Dim> const& layout) {
  return std::accumulate(layout.volumes.begin(), layout.volumes.end(), 0.0);
}

/// What moved in a layout that was made of the lattice, and that only along the first axis.
template <int Dim>
std::vector<double> moves(Layout<Dim> const& layout, int resolution) {
  Layout<Dim> const even = lattice(box<Dim>(), resolution);
  BOOST_TEST_REQUIRE(layout.positions.size() == even.positions.size());
  BOOST_TEST(layout.spacing == even.spacing);
  std::vector<double> along;
  for (std::size_t i = 0; i < even.positions.size(); ++i) {
    Vector<Dim> const move = layout.positions[i] - even.positions[i];
    for (int k = 1; k < Dim; ++k) BOOST_TEST(move[k] == 0.0);
    along.push_back(move[0] / even.spacing);
  }
  return along;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(neighbours_along_the_first_axis_come_together_in_pairs, D, Dimensions) {
  constexpr int Dim = D::value;
  for (int const resolution : {8, 5, 1}) {
    Layout<Dim> const layout = clumped(box<Dim>(), resolution, 0.1);
    std::vector<double> const along = moves(layout, resolution);
    std::size_t const rows = along.size() / static_cast<std::size_t>(resolution);
    for (std::size_t i = 0; i < along.size(); ++i) {
      std::size_t const place = i / rows;
      bool const alone = resolution % 2 == 1 && place + 1 == static_cast<std::size_t>(resolution);
      double const expected = alone ? 0.0 : place % 2 == 0 ? 0.45 : -0.45;
      BOOST_TEST(std::abs(along[i] - expected) < 1e-13);
      if (place % 2 == 1) {
        double const apart = (layout.positions[i] - layout.positions[i - rows]).norm();
        BOOST_TEST(apart == 0.1 * layout.spacing, tolerance(1e-12));
      }
    }
    BOOST_TEST(total(layout) == box<Dim>().volume(), tolerance(1e-13));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(pairs_one_spacing_apart_are_the_lattice, D, Dimensions) {
  constexpr int Dim = D::value;
  for (double const move : moves(clumped(box<Dim>(), 8, 1.0), 8)) BOOST_TEST(move == 0.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(only_the_first_of_each_row_stands_at_the_lower_wall, D, Dimensions) {
  constexpr int Dim = D::value;
  for (double const gap : {0.3, 1e-12}) {
    Domain<Dim> domain = box<Dim>();
    domain.lower[0] = 0.0;  // whose neighbourhood holds numbers as small as the gap
    Layout<Dim> const even = lattice(domain, 8);
    Layout<Dim> const layout = touching(domain, 8, gap);
    std::size_t touch = 0;
    for (std::size_t i = 0; i < even.positions.size(); ++i) {
      Vector<Dim> const x = layout.positions[i];
      for (int k = 1; k < Dim; ++k) BOOST_TEST(x[k] == even.positions[i][k]);
      if (even.positions[i][0] > even.cell[0]) {
        BOOST_TEST(x[0] == even.positions[i][0]);
      } else {
        BOOST_TEST(x[0] == gap * even.cell[0], tolerance(1e-13));
        ++touch;
      }
    }
    BOOST_TEST(8 * touch == even.positions.size());
    BOOST_TEST(total(layout) == domain.volume(), tolerance(1e-13));
  }
}

// Clumped pairs share their two cells evenly, but the one left over does not.
BOOST_AUTO_TEST_CASE(volumes_in_1d_reach_halfway_to_the_neighbours) {
  for (Layout<1> const& layout : {clumped(box<1>(), 7, 0.1), touching(box<1>(), 7, 0.1)}) {
    auto const& x = layout.positions.component(0);
    for (std::size_t i = 1; i < 6; ++i)
      BOOST_TEST(layout.volumes[i] == 0.5 * (x[i + 1] - x[i - 1]), tolerance(1e-12));
    BOOST_TEST(layout.volumes[0] == 0.5 * (x[0] + x[1]) + 0.5, tolerance(1e-12));
    BOOST_TEST(layout.volumes[6] == 1.5 - 0.5 * (x[5] + x[6]), tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(volumes_in_more_dimensions_are_those_of_the_cells) {
  for (Layout<2> const& layout : {clumped(box<2>(), 8, 0.1), touching(box<2>(), 8, 0.1)}) {
    for (double const volume : layout.volumes)
      BOOST_TEST(volume == layout.spacing * layout.spacing, tolerance(1e-13));
  }
}

BOOST_AUTO_TEST_CASE(in_a_turned_box_pairs_and_gaps_are_along_its_own_axis) {
  Domain<2> turned = box<2>();
  turned.axes << 0.8, -0.6, 0.6, 0.8;
  for (int which = 0; which < 2; ++which) {
    auto const make = [&](Domain<2> const& domain) {
      return which == 0 ? clumped(domain, 8, 0.2) : touching(domain, 8, 0.1);
    };
    Layout<2> const upright = make(box<2>());
    Layout<2> const layout = make(turned);
    for (std::size_t i = 0; i < layout.positions.size(); ++i) {
      BOOST_TEST((turned.to_box(layout.positions[i]) - upright.positions[i]).norm() < 1e-14);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
