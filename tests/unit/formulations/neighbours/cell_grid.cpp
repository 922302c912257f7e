// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/neighbours/cell_grid.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <map>

#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(formulations_neighbours_cell_grid)

using namespace sphverify;
using namespace sphverify::tests;

template <int Dim>
VectorField<Dim> scatter(Random& random, std::size_t count, double low = 0.0, double high = 1.0) {
  VectorField<Dim> positions(count);
  for (std::size_t i = 0; i < count; ++i) positions.set(i, random.vector<Dim>(low, high));
  return positions;
}

template <int Dim>
Domain<Dim> unit_box(std::array<bool, Dim> periodic = {}) {
  return {.lower = Vector<Dim>::Zero(), .upper = Vector<Dim>::Ones(), .periodic = periodic};
}

/// The shortest separation over all images of j in the adjacent periods.
template <int Dim>
Vector<Dim> brute_separation(Domain<Dim> const& domain, Vector<Dim> const& x, Vector<Dim> const& y) {
  Vector<Dim> best = x - y;
  for (int k = 0; k < Dim; ++k) {
    if (!domain.periodic[k]) continue;
    for (int image = -1; image <= 1; ++image) {
      double const candidate = x[k] - y[k] + image * (domain.upper[k] - domain.lower[k]);
      if (std::abs(candidate) < std::abs(best[k])) best[k] = candidate;
    }
  }
  return best;
}

/// Whether the grid visits, from x, every particle within reach once, with the right separation, and no
/// other.
template <int Dim>
bool agrees_with_brute_force(CellGrid<Dim> const& grid, Vector<Dim> const& x) {
  std::map<std::uint32_t, Vector<Dim>> found;
  bool good = true;
  grid.for_each_within_reach(x, [&](std::uint32_t j, Vector<Dim> const& separation, double distance) {
    good = good && found.emplace(j, separation).second && std::abs(distance - separation.norm()) < 1e-15;
  });
  std::size_t expected = 0;
  for (std::size_t j = 0; j < grid.positions().size(); ++j) {
    Vector<Dim> const separation = brute_separation(grid.domain(), x, grid.positions()[j]);
    auto const at = found.find(static_cast<std::uint32_t>(j));
    if (separation.norm() < grid.reach()) {
      ++expected;
      good = good && at != found.end() && (at->second - separation).norm() < 1e-14;
    }
  }
  return good && found.size() == expected;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(finds_what_brute_force_finds_with_and_without_periodic_axes, D, Dimensions) {
  constexpr int Dim = D::value;
  Random random(1);
  for (std::size_t const count : {1u, 2u, 5u, 300u}) {
    for (double const reach : {0.03, 0.11, 0.3, 0.34, 0.49, 0.5}) {
      for (unsigned axes = 0; axes < (1u << Dim); ++axes) {
        std::array<bool, Dim> periodic;
        for (int k = 0; k < Dim; ++k) periodic[k] = ((axes >> k) & 1u) != 0;
        VectorField<Dim> const positions = scatter<Dim>(random, count);
        CellGrid<Dim> const grid(positions, unit_box<Dim>(periodic), reach);
        bool good = true;
        for (std::size_t i = 0; i < count; ++i) good = good && agrees_with_brute_force(grid, positions[i]);
        for (int n = 0; n < 20; ++n)
          good = good && agrees_with_brute_force(grid, random.vector<Dim>(0.0, 1.0));
        BOOST_TEST(good, count << " particles, reach " << reach << ", periodic axes " << axes);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(reach_may_exceed_the_whole_cloud, D, Dimensions) {
  constexpr int Dim = D::value;
  Random random(2);
  VectorField<Dim> const positions = scatter<Dim>(random, 20);
  CellGrid<Dim> const grid(positions, unit_box<Dim>(), 5.0);
  BOOST_TEST(agrees_with_brute_force(grid, positions[3]));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(points_outside_the_cloud_find_its_particles, D, Dimensions) {
  constexpr int Dim = D::value;
  Random random(3);
  VectorField<Dim> const positions = scatter<Dim>(random, 200, 0.3, 0.7);
  CellGrid<Dim> const grid(positions, unit_box<Dim>(), 0.2);
  bool good = true;
  for (int n = 0; n < 200; ++n) good = good && agrees_with_brute_force(grid, random.vector<Dim>(-0.2, 1.2));
  BOOST_TEST(good);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(sparse_clouds_are_found_without_a_cell_for_every_empty_place, D, Dimensions) {
  constexpr int Dim = D::value;
  Random random(4);
  // 10^6 reaches across: a cell for each place would need 10^18 of them in 3D.
  VectorField<Dim> positions = scatter<Dim>(random, 200, -1e6, 1e6);
  for (std::size_t i = 0; i < 100; ++i) positions.set(i, positions[i + 100] + random.vector<Dim>(-0.5, 0.5));
  CellGrid<Dim> const grid(positions, unit_box<Dim>(), 1.0);
  bool good = true;
  for (std::size_t i = 0; i < positions.size(); ++i)
    good = good && agrees_with_brute_force(grid, positions[i]);
  BOOST_TEST(good);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(long_thin_clouds_keep_cells_no_smaller_than_the_reach, D, Dimensions) {
  constexpr int Dim = D::value;
  Random random(5);
  VectorField<Dim> positions = scatter<Dim>(random, 400);
  for (double& x : positions.component(0)) x *= 300.0;
  CellGrid<Dim> const grid(positions, unit_box<Dim>(), 0.9);
  bool good = true;
  for (std::size_t i = 0; i < positions.size(); ++i)
    good = good && agrees_with_brute_force(grid, positions[i]);
  BOOST_TEST(good);
}

BOOST_AUTO_TEST_CASE(particles_exactly_at_reach_are_not_found) {
  VectorField<1> positions(3);
  positions.component(0) = {0.0, 0.5, std::nextafter(0.5, 0.0)};
  CellGrid<1> const grid(positions, unit_box<1>(), 0.5);
  std::vector<std::uint32_t> found;
  grid.for_each_within_reach(positions[0],
                             [&](std::uint32_t j, Vector<1> const&, double) { found.push_back(j); });
  BOOST_TEST(found == (std::vector<std::uint32_t>{0, 2}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(particles_on_either_side_of_a_periodic_boundary_meet) {
  VectorField<1> positions(2);
  positions.component(0) = {0.01, 0.98};
  CellGrid<1> const grid(positions, unit_box<1>({true}), 0.1);
  double separation = 0.0;
  grid.for_each_within_reach(positions[0], [&](std::uint32_t j, Vector<1> const& s, double) {
    if (j == 1) separation = s[0];
  });
  BOOST_TEST(separation == 0.03, boost::test_tools::tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(periodic_axis_shorter_than_two_reaches_is_refused, D, Dimensions) {
  constexpr int Dim = D::value;
  Random random(6);
  VectorField<Dim> const positions = scatter<Dim>(random, 10);
  for (int axis = 0; axis < Dim; ++axis) {
    std::array<bool, Dim> periodic{};
    periodic[axis] = true;
    BOOST_CHECK_THROW(CellGrid<Dim>(positions, unit_box<Dim>(periodic), 0.501), std::invalid_argument);
    BOOST_CHECK_NO_THROW(CellGrid<Dim>(positions, unit_box<Dim>(periodic), 0.5));
  }
  BOOST_CHECK_NO_THROW(CellGrid<Dim>(positions, unit_box<Dim>(), 0.501));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(coordinates_that_are_not_finite_are_refused, D, Dimensions) {
  constexpr int Dim = D::value;
  for (double const bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Random random(7);
    VectorField<Dim> positions = scatter<Dim>(random, 10);
    positions.component(Dim - 1)[4] = bad;
    BOOST_CHECK_THROW(CellGrid<Dim>(positions, unit_box<Dim>(), 0.1), std::invalid_argument);
  }
}

/// Whether, for the particles of every cell in [first, last), the runs hold every image within reach exactly
/// once, at its place plus the run's shift. Counts the particles met.
template <int Dim>
bool runs_hold_all_images(CellGrid<Dim> const& grid, std::size_t first, std::size_t last,
                          std::vector<int>& visits) {
  Domain<Dim> const& domain = grid.domain();
  auto const& particles = grid.particles();
  int images = 1;
  for (int k = 0; k < Dim; ++k) images *= 3;
  bool good = true;
  grid.for_each_cell(first, last, [&](std::uint32_t begin, std::uint32_t end, auto const& runs) {
    good = good && begin < end;
    for (std::uint32_t s = begin; s < end; ++s) {
      std::uint32_t const i = particles[s];
      ++visits[i];
      Vector<Dim> const x = domain.to_box(grid.positions()[i]);
      for (std::uint32_t j = 0; j < particles.size(); ++j) {
        for (int image = 0; image < images; ++image) {
          Vector<Dim> shift = Vector<Dim>::Zero();
          int rest = image;
          bool exists = true;
          for (int k = 0; k < Dim; ++k, rest /= 3) {
            if (rest % 3 == 1) continue;
            exists = exists && domain.periodic[static_cast<std::size_t>(k)];
            shift[k] = (rest % 3 - 1) * domain.extent()[k];
          }
          Vector<Dim> const place = domain.to_box(grid.positions()[j]) + shift;
          if (!exists || (x - place).norm() >= grid.reach()) continue;
          int found = 0;
          for (auto const& run : runs) {
            if ((run.shift - shift).norm() != 0.0) continue;
            for (std::uint32_t n = run.begin; n < run.end; ++n) found += particles[n] == j ? 1 : 0;
          }
          good = good && found == 1;
        }
      }
    }
  });
  return good;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(runs_of_a_cell_hold_every_image_within_reach_once, D, Dimensions) {
  constexpr int Dim = D::value;
  Random random(8);
  for (std::size_t const count : {1u, 2u, 60u}) {
    for (double const reach : {0.11, 0.3, 0.34, 0.5}) {
      for (unsigned axes = 0; axes < (1u << Dim); ++axes) {
        for (bool const turned : {false, true}) {
          std::array<bool, Dim> periodic;
          for (int k = 0; k < Dim; ++k) periodic[static_cast<std::size_t>(k)] = ((axes >> k) & 1u) != 0;
          Domain<Dim> domain = unit_box<Dim>(periodic);
          if (turned) domain.axes = random.reflection<Dim>();
          VectorField<Dim> positions(count);
          for (std::size_t i = 0; i < count; ++i)
            positions.set(i, domain.to_space(random.vector<Dim>(0.0, 1.0)));
          CellGrid<Dim> const grid(positions, domain, reach);
          // In two parts, as threads take them.
          std::vector<int> visits(count, 0);
          std::size_t const middle = grid.cells() / 2;
          BOOST_TEST((runs_hold_all_images(grid, 0, middle, visits) &&
                      runs_hold_all_images(grid, middle, grid.cells(), visits)),
                     count << " particles, reach " << reach << ", periodic axes " << axes);
          BOOST_TEST((visits == std::vector<int>(count, 1)));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_turned_box_finds_what_it_finds_straight, D, Dimensions) {
  constexpr int Dim = D::value;
  Random random(9);
  std::array<bool, Dim> periodic;
  periodic.fill(true);
  Domain<Dim> const straight = unit_box<Dim>(periodic);
  Domain<Dim> turned = straight;
  turned.axes = random.reflection<Dim>();
  VectorField<Dim> const positions = scatter<Dim>(random, 200);
  VectorField<Dim> in_space(200);
  for (std::size_t i = 0; i < 200; ++i) in_space.set(i, turned.to_space(positions[i]));
  CellGrid<Dim> const one(positions, straight, 0.3);
  CellGrid<Dim> const other(in_space, turned, 0.3);
  for (std::size_t i = 0; i < 200; ++i) {
    std::map<std::uint32_t, Vector<Dim>> expected;
    one.for_each_within_reach(positions[i], [&](std::uint32_t j, Vector<Dim> const& separation, double) {
      expected.emplace(j, turned.to_space(separation));
    });
    bool good = true;
    std::size_t found = 0;
    other.for_each_within_reach(in_space[i], [&](std::uint32_t j, Vector<Dim> const& separation, double) {
      ++found;
      good = good && expected.contains(j) && (expected.at(j) - separation).norm() < 1e-14;
    });
    BOOST_REQUIRE(good);
    BOOST_REQUIRE_EQUAL(found, expected.size());
  }
}

BOOST_AUTO_TEST_CASE(no_particles_are_no_problem) {
  VectorField<2> const positions(0);
  CellGrid<2> const grid(positions, unit_box<2>(), 0.1);
  int visited = 0;
  grid.for_each_within_reach(Vector<2>(0.5, 0.5),
                             [&](std::uint32_t, Vector<2> const&, double) { ++visited; });
  BOOST_TEST(visited == 0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(threads_do_not_change_the_cells, D, Dimensions) {
  constexpr int dim = D::value;
  Random random(5);
  VectorField<dim> const positions = scatter<dim>(random, 10'001);
  CellGrid<dim> const one(positions, unit_box<dim>(), 0.07);
  for (int const threads : {2, 3, 7}) {
    CellGrid<dim> const several(positions, unit_box<dim>(), 0.07, threads);
    BOOST_TEST((several.particles() == one.particles()));
    BOOST_TEST_REQUIRE(several.cells() == one.cells());
    for (std::size_t c = 0; c <= one.cells(); ++c) BOOST_TEST_REQUIRE(several.first_in_cell(c) == one.first_in_cell(c));
    for (int k = 0; k < dim; ++k) {
      BOOST_TEST(several.origin(k) == one.origin(k));
      BOOST_TEST(several.cell_size(k) == one.cell_size(k));
    }
  }
  // Whoever is in a cell is there by its number.
  for (std::size_t c = 0; c < one.cells(); ++c) {
    auto const begin = one.particles().begin();
    BOOST_TEST_REQUIRE(std::is_sorted(begin + one.first_in_cell(c), begin + one.first_in_cell(c + 1)));
  }
}

BOOST_AUTO_TEST_SUITE_END()
