// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <numeric>

#include "formulations/layouts/layout.hpp"
#include "tests/support/random_particles.hpp"

// The layouts that are lattices other than the cubic one: `hexagonal` and `close_packed`.
BOOST_AUTO_TEST_SUITE(formulations_layouts_layout_packed)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

using PackedDimensions = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

template <int Dim>
Layout<Dim> packed(Domain<Dim> const& domain, int resolution) {
  if constexpr (Dim == 2) return hexagonal(domain, resolution);
  if constexpr (Dim == 3) return close_packed(domain, resolution);
}

/// Of sides 2, 1.3 (and 0.9), not about the origin.
template <int Dim>
Domain<Dim> box(bool periodic) {
  Domain<Dim> domain{.lower = Vector<Dim>::Constant(-0.5), .upper = Vector<Dim>::Constant(0.4)};
  domain.upper[0] = 1.5;
  domain.upper[1] = 0.8;
  domain.periodic.fill(periodic);
  return domain;
}

/// Distance from x to the nearest particle.
template <int Dim>
double nearest(VectorField<Dim> const& positions, Vector<Dim> const& x) {
  double least = INFINITY;
  for (std::size_t j = 0; j < positions.size(); ++j) least = std::min(least, (x - positions[j]).norm());
  return least;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(particles_fill_the_box_in_equal_parts_near_the_volume_asked_for, D,
                              PackedDimensions) {
  constexpr int Dim = D::value;
  Domain<Dim> const domain = box<Dim>(false);
  for (int const resolution : {1, 2, 7, 20, 33}) {
    Layout<Dim> const layout = packed(domain, resolution);
    double sum = 0.0;
    for (std::size_t i = 0; i < layout.volumes.size(); ++i) {
      sum += layout.volumes[i];
      BOOST_TEST(layout.volumes[i] == layout.volumes[0]);
      Vector<Dim> const x = layout.positions[i];
      BOOST_TEST(((x - domain.lower).minCoeff() > 0.0 && (domain.upper - x).minCoeff() > 0.0));
    }
    BOOST_TEST(layout.positions.size() == layout.volumes.size());
    BOOST_TEST(sum == domain.volume(), tolerance(1e-12));
    BOOST_TEST(std::pow(layout.spacing, Dim) == layout.volumes[0], tolerance(1e-14));
    // Rounding to whole cells may cost half a cell along each axis.
    if (resolution >= 20) BOOST_TEST(layout.spacing == 2.0 / resolution, tolerance(0.05));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(half_a_turn_of_the_box_changes_nothing, D, PackedDimensions) {
  constexpr int Dim = D::value;
  Domain<Dim> const domain = box<Dim>(false);
  Layout<Dim> const layout = packed(domain, 9);
  Vector<Dim> const centre = 0.5 * (domain.lower + domain.upper);
  for (int axis = 2; axis > 2 - (Dim == 2 ? 1 : 3); --axis) {
    for (std::size_t i = 0; i < layout.volumes.size(); ++i) {
      Vector<Dim> turned = 2.0 * centre - layout.positions[i];
      if (axis < Dim) turned[axis] = layout.positions[i][axis];
      BOOST_TEST(nearest(layout.positions, turned) < 1e-12);
    }
  }
}

BOOST_AUTO_TEST_CASE(both_ends_of_an_axis_have_the_same_distance_to_the_particles) {
  for (int const resolution : {3, 10}) {
    Domain<2> const domain = box<2>(false);
    Layout<2> const plane = hexagonal(domain, resolution);
    Layout<3> const space = close_packed(box<3>(false), resolution);
    auto const gaps = [](auto const& layout, auto const& within, int k) {
      auto const& x = layout.positions.component(k);
      auto const [low, high] = std::minmax_element(x.begin(), x.end());
      return std::pair{(*low - within.lower[k]) / layout.cell[k], (within.upper[k] - *high) / layout.cell[k]};
    };
    double const expected[] = {0.25, 0.5};
    for (int k = 0; k < 2; ++k) {
      auto const [low, high] = gaps(plane, domain, k);
      BOOST_TEST(low == expected[k], tolerance(1e-12));
      BOOST_TEST(high == expected[k], tolerance(1e-12));
    }
    for (int k = 0; k < 3; ++k) {
      auto const [low, high] = gaps(space, box<3>(false), k);
      BOOST_TEST(low == 0.25, tolerance(1e-12));
      BOOST_TEST(high == 0.25, tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(in_a_periodic_box_all_have_their_6_or_12_nearest_at_about_the_same_distance, D,
                              PackedDimensions) {
  constexpr int Dim = D::value;
  std::size_t const neighbours = Dim == 2 ? 6 : 12;
  // The distance in an unstretched lattice of the same volume: V = a^2 sqrt(3)/2 and a^3/sqrt(2).
  double const ideal = Dim == 2 ? std::sqrt(2.0 / std::sqrt(3.0)) : std::pow(2.0, 1.0 / 6.0);
  Domain<Dim> const domain = box<Dim>(true);
  Layout<Dim> const layout = packed(domain, 24);
  CellGrid<Dim> const grid(layout.positions, domain, 1.5 * layout.spacing);
  for (std::size_t i = 0; i < layout.volumes.size(); ++i) {
    std::vector<double> distances;
    grid.for_each_within_reach(layout.positions[i], [&](std::size_t j, Vector<Dim> const&, double distance) {
      if (j != i) distances.push_back(distance / (ideal * layout.spacing));
    });
    std::sort(distances.begin(), distances.end());
    BOOST_REQUIRE(distances.size() > neighbours - 1);
    // By 5% at most it is stretched; the next neighbours are sqrt(3) and sqrt(2) times as far.
    BOOST_TEST((distances.front() > 0.95 && distances[neighbours - 1] < 1.05));
    BOOST_TEST((distances.size() == neighbours || distances[neighbours] > 1.3));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_periodic_box_beside_itself_is_one_longer_lattice, D, PackedDimensions) {
  constexpr int Dim = D::value;
  // Sides of nearly whole cells, so that twice as long is twice as many.
  Domain<Dim> domain = box<Dim>(true);
  domain.upper[1] = 0.7;
  if (Dim == 3) domain.upper[2] = 0.3;
  int const resolution = Dim == 2 ? 13 : 8;
  Layout<Dim> const layout = packed(domain, resolution);
  for (int k = 0; k < Dim; ++k) {
    Domain<Dim> twice = domain;
    twice.upper[k] += domain.extent()[k];
    Layout<Dim> const longer = packed(twice, k == 0 ? 2 * resolution : resolution);
    BOOST_REQUIRE(longer.volumes.size() == 2 * layout.volumes.size());
    for (std::size_t i = 0; i < layout.volumes.size(); ++i) {
      Vector<Dim> const there = layout.positions[i] + domain.extent()[k] * Vector<Dim>::Unit(k);
      BOOST_TEST(nearest(longer.positions, Vector<Dim>(layout.positions[i])) < 1e-12);
      BOOST_TEST(nearest(longer.positions, there) < 1e-12);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_turned_box_has_the_turned_particles, D, PackedDimensions) {
  constexpr int Dim = D::value;
  Domain<Dim> turned = box<Dim>(false);
  turned.axes = Random(3).rotation<Dim>();
  Layout<Dim> const layout = packed(box<Dim>(false), 6);
  Layout<Dim> const found = packed(turned, 6);
  BOOST_REQUIRE(found.volumes.size() == layout.volumes.size());
  for (std::size_t i = 0; i < layout.volumes.size(); ++i) {
    BOOST_TEST((found.positions[i] - turned.axes * layout.positions[i]).norm() < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(counts_are_known_beforehand_even_where_there_is_no_memory) {
  for (int const resolution : {1, 3, 8, 20}) {
    BOOST_TEST(hexagonal_count(box<2>(false), resolution) ==
               static_cast<double>(hexagonal(box<2>(false), resolution).volumes.size()));
    BOOST_TEST(close_packed_count(box<3>(false), resolution) ==
               static_cast<double>(close_packed(box<3>(false), resolution).volumes.size()));
    BOOST_TEST(lattice_count(box<3>(false), resolution) ==
               static_cast<double>(lattice(box<3>(false), resolution).volumes.size()));
  }
  double const many = 2.34 / 8.0 * 1e27;  // of side 2, 1.3, 0.9 with dx = 2e-9
  BOOST_TEST(close_packed_count(box<3>(false), 1'000'000'000) == many, tolerance(1e-6));
  BOOST_TEST(lattice_count(box<3>(false), 1'000'000'000) == many, tolerance(1e-6));
}

BOOST_AUTO_TEST_SUITE_END()
