#include "formulations/support/pair_weights.hpp"

#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_support_pair_weights)

using namespace sphverify;
using namespace sphverify::tests;

constexpr KernelWeightSet both{KernelWeight::gradient, KernelWeight::radial};

BOOST_AUTO_TEST_CASE_TEMPLATE(gradient_points_from_neighbour_to_particle_and_falls_with_distance, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  Scene<Dim> const scene = random_scene<Dim>(1, 40);
  PairGeometry<Dim> const geometry = geometry_of(scene, both, false);
  dense::State<Dim> const s(scene);
  BOOST_TEST_REQUIRE(geometry.neighbours.pairs() > 40u);
  double const scale = dense::kernel<Dim>(0.0, s.h()) / s.h();
  for (std::size_t i = 0; i < 40; ++i) {
    for (std::size_t k = geometry.neighbours.first[i]; k < geometry.neighbours.first[i + 1]; ++k) {
      std::size_t const j = geometry.neighbours.neighbour[k];
      Vector<Dim> const expected = s.gradient(i, j);
      Vector<Dim> const r = s.x(i) - s.x(j);
      BOOST_TEST((geometry.weights.gradient[k] - expected).norm() < 1e-13 * scale);
      BOOST_TEST(std::abs(geometry.weights.radial[k] * r.squaredNorm() - r.dot(expected)) <
                 1e-13 * scale * r.norm());
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(gradient_is_exactly_antisymmetric, D, Dimensions) {
  constexpr int Dim = D::value;
  Scene<Dim> scene = random_scene<Dim>(1, 60);
  scene.domain.periodic.fill(true);
  PairGeometry<Dim> geometry;
  double const h = 0.2;
  CellGrid<Dim> const grid(scene.particles.positions(), scene.domain, 2.0 * h);
  NeighbourList const list = find_neighbours(grid);
  auto const weights = evaluate_kernel<Dim>(list, scene.particles.positions(), scene.domain, h, both);
  auto const pair = [&](std::size_t i, std::size_t j) {
    auto const row = list.row(i);
    return list.first[i] + static_cast<std::size_t>(std::ranges::lower_bound(row, j) - row.begin());
  };
  bool exact = true;
  for (std::size_t i = 0; i < 60; ++i) {
    for (std::uint32_t const j : list.row(i)) {
      Vector<Dim> const sum = weights.gradient[pair(i, j)] + weights.gradient[pair(j, i)];
      exact = exact && sum.norm() == 0.0 && weights.radial[pair(i, j)] == weights.radial[pair(j, i)];
    }
  }
  BOOST_TEST(exact);
}

BOOST_AUTO_TEST_CASE(gradient_crosses_a_periodic_boundary_the_short_way) {
  VectorField<1> positions(2);
  positions.component(0) = {0.05, 0.95};
  Domain<1> const domain{.lower = Vector<1>(0.0), .upper = Vector<1>(1.0), .periodic = {true}};
  NeighbourList const list = find_neighbours(CellGrid<1>(positions, domain, 0.2));
  auto const weights = evaluate_kernel<1>(list, positions, domain, 0.1, both);
  BOOST_TEST(weights.gradient[0][0] == -0.5 / (0.1 * 0.1), boost::test_tools::tolerance(1e-12));  // r = +h
  BOOST_TEST(weights.gradient[1][0] == 0.5 / (0.1 * 0.1), boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(only_what_was_asked_for_is_stored) {
  Scene<3> const scene = random_scene<3>(1, 40);
  PairGeometry<3> const gradient = geometry_of(scene, {KernelWeight::gradient}, false);
  PairGeometry<3> const radial = geometry_of(scene, {KernelWeight::radial}, false);
  std::size_t const pairs = gradient.neighbours.pairs();
  BOOST_TEST(gradient.weights.gradient.size() == pairs);
  BOOST_TEST(gradient.weights.radial.empty());
  BOOST_TEST(gradient.weights.bytes() == 3 * pairs * sizeof(double));
  BOOST_TEST(radial.weights.gradient.size() == 0u);
  BOOST_TEST(radial.weights.radial.size() == pairs);
  BOOST_TEST(radial.weights.bytes() == pairs * sizeof(double));
  BOOST_TEST(radial.bytes() == radial.weights.bytes() + radial.neighbours.bytes());
}

BOOST_AUTO_TEST_SUITE_END()
