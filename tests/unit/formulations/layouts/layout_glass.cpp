// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <complex>
#include <numeric>

#include "formulations/kernels/cubic_spline.hpp"
#include "formulations/layouts/layout.hpp"
#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(formulations_layouts_layout_glass)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

using GlassDimensions = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

/// Twice as long as wide, or a cube, not at the origin; the last axis periodic.
template <int Dim>
Domain<Dim> box() {
  Domain<Dim> domain{.lower = Vector<Dim>::Constant(-0.5), .upper = Vector<Dim>::Constant(0.5)};
  if (Dim == 2) domain.upper[0] = 1.5;
  domain.periodic[Dim - 1] = true;
  return domain;
}

template <int Dim>
constexpr int resolution = Dim == 2 ? 64 : 14;

/// The particles of an upright box and their nearest images beyond its sides, in spacings: mirror images, or
/// the other end where an axis is periodic.
template <int Dim>
std::vector<Vector<Dim>> with_images(Layout<Dim> const& layout, Domain<Dim> const& domain, double reach) {
  std::vector<Vector<Dim>> points;
  for (std::size_t i = 0; i < layout.volumes.size(); ++i) points.push_back(layout.positions[i]);
  for (int k = 0; k < Dim; ++k) {
    std::size_t const count = points.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (bool const low : {true, false}) {
        double const side = low ? domain.lower[k] : domain.upper[k];
        Vector<Dim> image = points[i];
        image[k] =
            domain.periodic[k] ? image[k] + (low ? -1.0 : 1.0) * domain.extent()[k] : 2.0 * side - image[k];
        if (std::abs(image[k] - side) < reach * layout.spacing &&
            (low ? image[k] <= side : image[k] >= side)) {
          points.push_back(image);
        }
      }
    }
  }
  for (Vector<Dim>& x : points) x /= layout.spacing;
  return points;
}

struct Spread {
  double mean = 0.0, deviation = 0.0;
};

Spread spread(std::vector<double> const& values) {
  auto const n = static_cast<double>(values.size());
  double const mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0.0;
  for (double const value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / n)};
}

/// What is told of a layout by brute force, lengths in spacings.
struct Statistics {
  Spread density_inside, density_at_walls;  ///< by summation, h/dx = 1.2; of equal volumes it should be 1
  Spread nearest;                           ///< distance to the nearest neighbour
  double least_distance = INFINITY;         ///< of two particles in the box
  /// Of the bonds below 1.4 along the axes: mean exp(4 i phi) in the plane of the first two. Away from walls,
  /// which do order the layers along them.
  double order = 0.0;
};

template <int Dim>
Statistics statistics(Layout<Dim> const& layout, Domain<Dim> const& domain) {
  double const h = 1.2;
  std::size_t const count = layout.volumes.size();
  auto const points = with_images(layout, domain, 2.0 * h);
  std::vector<double> inside;
  std::vector<double> at_walls;
  std::vector<double> nearest;
  std::complex<double> bonds = 0.0;
  double bond_count = 0.0;
  Statistics found;
  for (std::size_t i = 0; i < count; ++i) {
    bool near_wall = false;
    for (int k = 0; k < Dim; ++k) {
      double const to_side =
          std::min(layout.positions[i][k] - domain.lower[k], domain.upper[k] - layout.positions[i][k]);
      near_wall = near_wall || (!domain.periodic[k] && to_side < 2.0 * h * layout.spacing);
    }
    double density = 0.0;
    double least = INFINITY;
    for (std::size_t j = 0; j < points.size(); ++j) {
      Vector<Dim> const separation = points[j] - points[i];
      double const distance = separation.norm();
      density += CubicSpline<Dim>::value(distance, h);
      if (j == i) continue;
      least = std::min(least, distance);
      if (j < count) found.least_distance = std::min(found.least_distance, distance);
      if (!near_wall && distance < 1.4 && separation.template head<2>().norm() > 0.0) {
        std::complex<double> const along = {separation[0], separation[1]};
        std::complex<double> const squared = along * along / std::norm(along);
        bonds += squared * squared;
        bond_count += 1.0;
      }
    }
    (near_wall ? at_walls : inside).push_back(density);
    nearest.push_back(least);
  }
  found.density_inside = spread(inside);
  found.density_at_walls = spread(at_walls);
  found.nearest = spread(nearest);
  found.order = std::abs(bonds) / bond_count;
  return found;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(density_is_even_inside_and_at_walls, D, GlassDimensions) {
  constexpr int Dim = D::value;
  Domain<Dim> const domain = box<Dim>();
  Statistics const displaced = statistics(jittered(domain, resolution<Dim>, 0.2, 1), domain);
  for (std::uint64_t const seed : {1u, 2u}) {
    Statistics const found = statistics(glass(domain, resolution<Dim>, seed), domain);
    for (auto const& density : {found.density_inside, found.density_at_walls}) {
      BOOST_TEST_MESSAGE("density " << density.mean << " +- " << density.deviation);
      BOOST_TEST(density.mean == 1.0, tolerance(0.005));
      BOOST_TEST(density.deviation < 0.01);
    }
    BOOST_TEST(found.density_inside.deviation < 0.2 * displaced.density_inside.deviation);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(no_two_particles_are_close_and_distances_are_spread, D, GlassDimensions) {
  constexpr int Dim = D::value;
  Domain<Dim> const domain = box<Dim>();
  Statistics const found = statistics(glass(domain, resolution<Dim>, 1), domain);
  BOOST_TEST_MESSAGE("least " << found.least_distance << " nearest " << found.nearest.mean << " +- "
                              << found.nearest.deviation);
  BOOST_TEST(found.least_distance > 0.7);
  BOOST_TEST(found.nearest.mean > 0.9);
  BOOST_TEST(found.nearest.deviation > 0.02);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(nothing_is_left_of_the_directions_of_the_cells_it_started_from, D,
                              GlassDimensions) {
  constexpr int Dim = D::value;
  Domain<Dim> const domain = box<Dim>();
  Statistics const found = statistics(glass(domain, resolution<Dim>, 3), domain);
  BOOST_TEST_MESSAGE("order " << found.order);
  BOOST_TEST(found.order < 0.03);
  BOOST_TEST(statistics(jittered(domain, resolution<Dim>, 0.2, 3), domain).order > 0.1);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(all_are_in_the_box_with_equal_parts_of_it, D, GlassDimensions) {
  constexpr int Dim = D::value;
  for (int const coarse : {1, 2, 9}) {  // so few that a particle meets several images of another
    Domain<Dim> const domain = box<Dim>();
    Layout<Dim> const layout = glass(domain, coarse, 5);
    BOOST_TEST(static_cast<double>(layout.volumes.size()) == lattice_count(domain, coarse));
    double sum = 0.0;
    for (std::size_t i = 0; i < layout.volumes.size(); ++i) {
      sum += layout.volumes[i];
      BOOST_TEST(layout.volumes[i] == layout.volumes[0]);
      Vector<Dim> const x = layout.positions[i];
      BOOST_TEST(((x - domain.lower).minCoeff() >= 0.0 && (domain.upper - x).minCoeff() >= 0.0));
    }
    BOOST_TEST(sum == domain.volume(), tolerance(1e-12));
    BOOST_TEST(std::pow(layout.spacing, Dim) == layout.volumes[0], tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE(a_strip_one_particle_wide_is_filled_evenly) {
  Domain<2> strip{.lower = {0.0, 0.0}, .upper = {1.0, 0.05}};
  for (bool const periodic : {false, true}) {
    strip.periodic[1] = periodic;
    Layout<2> const layout = glass(strip, 20, 1);
    std::vector<double> x = layout.positions.component(0);
    std::sort(x.begin(), x.end());
    for (std::size_t i = 0; i < x.size(); ++i) {
      BOOST_TEST(std::abs(x[i] - 0.05 * (static_cast<double>(i) + 0.5)) < 0.5 * 0.05);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(one_seed_gives_the_same_bits_and_another_seed_another_glass, D,
                              GlassDimensions) {
  constexpr int Dim = D::value;
  auto const x = [](std::uint64_t seed) { return glass(box<Dim>(), 8, seed).positions.component(0); };
  std::vector<double> const three = x(3);
  std::vector<double> const four = x(4);
  BOOST_TEST(same_bits(three, x(3)));
  double furthest = 0.0;
  for (std::size_t i = 0; i < three.size(); ++i) furthest = std::max(furthest, std::abs(three[i] - four[i]));
  BOOST_TEST(furthest > 0.1 / 8.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_turned_box_has_the_turned_particles, D, GlassDimensions) {
  constexpr int Dim = D::value;
  Domain<Dim> turned = box<Dim>();
  turned.axes = Random(3).rotation<Dim>();
  Layout<Dim> const layout = glass(box<Dim>(), 8, 2);
  Layout<Dim> const found = glass(turned, 8, 2);
  for (std::size_t i = 0; i < layout.volumes.size(); ++i) {
    BOOST_TEST((found.positions[i] - turned.axes * layout.positions[i]).norm() < 1e-14);
  }
}

BOOST_AUTO_TEST_SUITE_END()
