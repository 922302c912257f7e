// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/layouts/layout.hpp"

#include <boost/test/unit_test.hpp>
#include <numeric>

#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(formulations_layouts_layout)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

template <int Dim>
Domain<Dim> box() {
  Domain<Dim> domain{.lower = Vector<Dim>::Constant(-0.5), .upper = Vector<Dim>::Constant(1.5)};
  domain.upper[Dim - 1] = 0.5;  // half as long as the others, but for 1D: 1
  return domain;
}

template <int Dim>
double total(Layout<Dim> const& layout) {
  return std::accumulate(layout.volumes.begin(), layout.volumes.end(), 0.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(lattice_puts_a_particle_at_the_centre_of_each_of_equal_cells, D, Dimensions) {
  constexpr int Dim = D::value;
  Layout<Dim> const layout = lattice(box<Dim>(), 8);
  std::size_t const expected[] = {8, 8 * 4, 8 * 8 * 4};
  BOOST_TEST(layout.positions.size() == expected[Dim - 1]);
  BOOST_TEST(layout.spacing == box<Dim>().extent()[0] / 8);
  BOOST_TEST(total(layout) == box<Dim>().extent().prod(), tolerance(1e-13));
  for (int k = 0; k < Dim; ++k) {
    auto const& x = layout.positions.component(k);
    BOOST_TEST(*std::min_element(x.begin(), x.end()) == -0.5 + 0.5 * layout.spacing, tolerance(1e-13));
    BOOST_TEST(*std::max_element(x.begin(), x.end()) == box<Dim>().upper[k] - 0.5 * layout.spacing,
               tolerance(1e-13));
  }
  CellGrid<Dim> const grid(layout.positions, box<Dim>(), 1.5 * layout.spacing);
  BOOST_TEST(find_neighbours(grid).pairs() > 0u);  // and no two at the same place
  BOOST_TEST(find_neighbours(CellGrid<Dim>(layout.positions, box<Dim>(), 0.99 * layout.spacing)).pairs() ==
             0u);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(jitter_moves_every_coordinate_by_at_most_its_amplitude_and_fills_that_range, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  int const resolution = Dim == 1 ? 400 : 20;
  Layout<Dim> const even = lattice(box<Dim>(), resolution);
  Layout<Dim> const moved = jittered(box<Dim>(), resolution, 0.2, 7);
  double const most = 0.2 * even.spacing;
  for (int k = 0; k < Dim; ++k) {
    double least = 1.0;
    double largest_move = -1.0;
    double mean = 0.0;
    for (std::size_t i = 0; i < even.volumes.size(); ++i) {
      double const move = (moved.positions[i] - even.positions[i])[k] / most;
      least = std::min(least, move);
      largest_move = std::max(largest_move, move);
      mean += move / static_cast<double>(even.volumes.size());
    }
    BOOST_TEST((least > -1.0 - 1e-12 && least < -0.95));
    BOOST_TEST((largest_move < 1.0 + 1e-12 && largest_move > 0.95));
    BOOST_TEST(std::abs(mean) < 0.1);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(same_seed_gives_the_same_particles_and_another_seed_others, D, Dimensions) {
  constexpr int Dim = D::value;
  auto const x = [](std::uint64_t seed) { return jittered(box<Dim>(), 8, 0.1, seed).positions.component(0); };
  BOOST_TEST(same_bits(x(3), x(3)));
  BOOST_TEST(!same_bits(x(3), x(4)));
}

BOOST_AUTO_TEST_CASE(jitter_is_the_top_53_bits_of_the_standard_mersenne_twister) {
  Layout<1> const layout = jittered(box<1>(), 1, 0.25, 5489);
  // The first output of mt19937_64 from its default seed is 14514284786278117030.
  double const deviate = std::ldexp(static_cast<double>(14514284786278117030ull >> 11), -52) - 1.0;
  BOOST_TEST(layout.positions[0][0] == 0.0 + 0.25 * deviate, tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(volumes_of_disordered_particles_in_1d_reach_halfway_to_their_neighbours) {
  for (bool const periodic : {false, true}) {
    Domain<1> domain = box<1>();
    domain.periodic[0] = periodic;
    Layout<1> const layout = jittered(domain, 30, 0.3, 2);
    auto const& x = layout.positions.component(0);
    BOOST_TEST(total(layout) == 1.0, tolerance(1e-13));
    for (std::size_t i = 1; i < 29; ++i) {
      BOOST_TEST(layout.volumes[i] == 0.5 * (x[i + 1] - x[i - 1]), tolerance(1e-12));
    }
    double const first = periodic ? 0.5 * (x[1] - (x[29] - 1.0)) : 0.5 * (x[0] + x[1]) - domain.lower[0];
    double const last = periodic ? 0.5 * (x[0] + 1.0 - x[28]) : domain.upper[0] - 0.5 * (x[28] + x[29]);
    BOOST_TEST(layout.volumes[0] == first, tolerance(1e-12));
    BOOST_TEST(layout.volumes[29] == last, tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(volumes_of_disordered_particles_in_more_dimensions_are_those_of_their_cells) {
  Layout<2> const layout = jittered(box<2>(), 8, 0.3, 2);
  for (double const volume : layout.volumes)
    BOOST_TEST(volume == layout.spacing * layout.spacing, tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(reordering_moves_positions_and_volumes_together) {
  Layout<2> layout;
  layout.positions = lattice(box<2>(), 2).positions;
  layout.volumes = {1.0, 2.0, 3.0, 4.0};
  Layout<2> const before = layout;
  std::vector<std::uint32_t> const order{2, 0, 3, 1};
  reorder(layout, order);
  for (std::size_t n = 0; n < 4; ++n) {
    BOOST_TEST(layout.volumes[n] == before.volumes[order[n]]);
    BOOST_TEST((layout.positions[n] - before.positions[order[n]]).norm() == 0.0);
  }
}

/// Means and variances of uniform deviates, as many in either half of every axis, and axes that know nothing of each other.
BOOST_AUTO_TEST_CASE_TEMPLATE(random_places_are_uniform_and_independent, D, Dimensions) {
  constexpr int Dim = D::value;
  Domain<Dim> const domain = box<Dim>();
  Layout<Dim> const layout = at_random(domain, Dim == 1 ? 4000 : Dim == 2 ? 90 : 20, 3);
  auto const n = static_cast<double>(layout.positions.size());
  BOOST_TEST(total(layout) == domain.extent().prod(), tolerance(1e-12));
  double const allowed = 4.0 / std::sqrt(12.0 * n);  // standard deviations of a mean
  Matrix<Dim> products = Matrix<Dim>::Zero();
  Vector<Dim> mean = Vector<Dim>::Zero();
  for (std::size_t i = 0; i < layout.positions.size(); ++i) {
    Vector<Dim> const u = (layout.positions[i] - domain.lower).cwiseQuotient(domain.extent()) - Vector<Dim>::Constant(0.5);
    BOOST_TEST_REQUIRE(u.cwiseAbs().maxCoeff() < 0.5);
    mean += u / n;
    products += u * u.transpose() / n;
  }
  for (int k = 0; k < Dim; ++k) {
    BOOST_TEST(std::abs(mean[k]) < allowed);
    for (int l = 0; l < Dim; ++l) BOOST_TEST(std::abs(products(k, l) - (k == l ? 1.0 / 12.0 : 0.0)) < allowed);
  }
  BOOST_TEST(!same_bits(at_random(domain, 8, 4).positions.component(0), at_random(domain, 8, 5).positions.component(0)));
  BOOST_TEST(same_bits(at_random(domain, 8, 4).positions.component(0), at_random(domain, 8, 4).positions.component(0)));
}

BOOST_AUTO_TEST_SUITE_END()
