// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/density/density.hpp"

#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_density_density)

using namespace sphverify;
using namespace sphverify::tests;

/// A lattice on [0, depth] along x between walls at both ends, periodic along the other axes.
template <int Dim>
RandomScene<Dim> slab(int depth, int width, double smoothing_ratio) {
  std::size_t count = static_cast<std::size_t>(depth);
  for (int k = 1; k < Dim; ++k) count *= static_cast<std::size_t>(width);
  RandomScene<Dim> scene{.particles = Particles<Dim>(count, smoothing_ratio),
                         .domain = {.lower = Vector<Dim>::Zero(), .upper = Vector<Dim>::Constant(width)}};
  scene.domain.upper[0] = depth;
  scene.domain.periodic.fill(true);
  scene.domain.periodic[0] = false;
  scene.particles.allocate(all_fields);
  for (std::size_t i = 0; i < count; ++i) {
    Vector<Dim> x;
    x[0] = static_cast<double>(i % static_cast<std::size_t>(depth)) + 0.5;
    std::size_t rest = i / static_cast<std::size_t>(depth);
    for (int k = 1; k < Dim; ++k) {
      x[k] = static_cast<double>(rest % static_cast<std::size_t>(width)) + 0.5;
      rest /= static_cast<std::size_t>(width);
    }
    scene.particles.positions().set(i, x);
    scene.particles.masses()[i] = 1.0;
    scene.particles.scalar(Field::density)[i] = 1.0;
  }
  Vector<Dim> const n = Vector<Dim>::Unit(0);
  scene.walls.push_back({.point = Vector<Dim>::Zero(), .outward_normal = -n});
  scene.walls.push_back({.point = depth * n, .outward_normal = n});
  return scene;
}

template <int Dim>
std::vector<double> summation(RandomScene<Dim> const& scene) {
  double const h = scene.particles.smoothing_length();
  CellGrid<Dim> const grid(scene.particles.positions(), scene.domain, 2.0 * h);
  return summation_density(grid, SmoothingLength(scene.particles), scene.particles.masses());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(summation_is_a_dense_sum_with_the_particle_itself, D, Dimensions) {
  constexpr int Dim = D::value;
  for (std::size_t const count : {1u, 2u, 60u}) {
    RandomScene<Dim> const scene = random_scene<Dim>(count, count);
    dense::State<Dim> const s(scene);
    std::vector<double> expected(count, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        expected[i] += s.m(j) * dense::kernel<Dim>((s.x(i) - s.x(j)).norm(), s.h());
      }
    }
    BOOST_TEST(relative_difference(summation(scene), expected) < 1e-13);
  }
}

// Eq. 5. The first particle is half a spacing from the wall, so that what it sees is Gamma(dx/2), and
// Gamma(0) = 1/2 only in the limit of many particles in the kernel.
BOOST_AUTO_TEST_CASE(summation_falls_to_half_at_a_wall_as_the_kernel_is_resolved) {
  double last = 1.0;
  for (double const ratio : {1.2, 4.0, 16.0, 64.0}) {
    double const density = summation(slab<1>(400, 1, ratio))[0];
    double const gamma = dense::inner_fraction<1>(0.5, ratio);
    BOOST_TEST_MESSAGE("h/dx = " << ratio << ": density of the first particle " << density << ", Gamma "
                                 << gamma);
    BOOST_TEST(density == gamma, boost::test_tools::tolerance(ratio < 2.0 ? 0.04 : 2e-3));
    BOOST_TEST(density < last);
    last = density;
  }
  BOOST_TEST(last == 0.5, boost::test_tools::tolerance(0.02));
}

template <int Dim>
struct Resolved {
  static RandomScene<Dim> slab_of() {
    if constexpr (Dim == 1)
      return slab<1>(100, 1, 8.0);
    else if constexpr (Dim == 2)
      return slab<2>(26, 24, 6.0);
    else
      return slab<3>(12, 11, 2.7);
  }
};

BOOST_AUTO_TEST_CASE_TEMPLATE(normalised_summation_restores_a_uniform_density_up_to_the_wall, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = Resolved<Dim>::slab_of();
  std::vector<double> density = summation(scene);
  BOOST_TEST(density[0] < 0.7);
  for (std::size_t i = 0; i < density.size(); ++i) {
    density[i] /= kernel_inside(scene.particles.positions()[i], scene.walls,
                                scene.particles.smoothing_length(), default_kernel(Dim));
  }
  BOOST_TEST(relative_difference(density, std::vector<double>(density.size(), 1.0)) < 0.01);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(kernel_inside_loses_what_lies_beyond_each_of_two_parallel_walls, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  std::vector<Wall<Dim>> walls = Resolved<Dim>::slab_of().walls;
  walls[1].point[0] = 1.5;
  Vector<Dim> const x = Vector<Dim>::Constant(0.4);
  double const h = 0.9;
  double const expected = dense::inner_fraction<Dim>(0.4, h) + dense::inner_fraction<Dim>(1.1, h) - 1.0;
  BOOST_TEST(kernel_inside(x, walls, h, default_kernel(Dim)) == expected,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(kernel_inside(x, {}, h, default_kernel(Dim)) == 1.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(kernel_inside_knows_corners, D, Dimensions) {
  constexpr int Dim = D::value;
  std::vector<Wall<Dim>> walls;
  for (int k = 0; k < Dim; ++k)
    walls.push_back({.point = Vector<Dim>::Zero(), .outward_normal = -Vector<Dim>::Unit(k)});
  Vector<Dim> const corner = Vector<Dim>::Zero();
  BOOST_TEST(std::abs(kernel_inside(corner, walls, 0.3, default_kernel(Dim)) - std::pow(0.5, Dim)) < 1e-12);
  Vector<Dim> const near = Vector<Dim>::Constant(0.1);
  double one_by_one = 1.0;
  for (int k = 0; k < Dim; ++k) one_by_one -= 1.0 - dense::inner_fraction<Dim>(0.1, 0.3);
  if (Dim == 1)
    BOOST_TEST(kernel_inside(near, walls, 0.3, default_kernel(Dim)) == one_by_one,
               boost::test_tools::tolerance(1e-12));
  else
    BOOST_TEST(kernel_inside(near, walls, 0.3, default_kernel(Dim)) > one_by_one + 0.05);
}

/// What Eq. 74 makes of the constant one at a wall of a lattice with summation density.
template <int Dim>
double interpolated_constant(RandomScene<Dim> scene) {
  scene.particles.scalar(Field::density) = summation(scene);
  scene.particles.scalar(Field::pressure).assign(scene.particles.size(), 1.0);
  PairGeometry<Dim> geometry = geometry_of(scene);
  fill_boundary_values(geometry.contacts[0], geometry.walls[0], scene.particles, {BoundaryValue::pressure},
                       Closure::interpolated, 0.0);
  return geometry.contacts[0].pressure[0];
}

// The volumes m/rho swell at the wall: the limit is 2 int A/Gamma = 2 [ln Gamma] = 2 ln 2 in any dimension.
BOOST_AUTO_TEST_CASE(wall_interpolation_of_a_constant_with_summation_density_is_too_large) {
  auto const at = [](double ratio) { return interpolated_constant(slab<1>(400, 1, ratio)); };
  for (double const ratio : {1.0, 1.2, 4.0, 16.0, 64.0}) {
    BOOST_TEST_MESSAGE("h/dx = " << ratio << ": the constant 1 is interpolated as " << at(ratio));
  }
  BOOST_TEST(at(1.2) == 1.25, boost::test_tools::tolerance(0.005));
  BOOST_TEST(at(64.0) == 2.0 * std::numbers::ln2, boost::test_tools::tolerance(1e-4));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(its_limit_is_2_ln_2_in_every_dimension, D, Dimensions) {
  double const found = interpolated_constant(Resolved<D::value>::slab_of());
  BOOST_TEST_MESSAGE(D::value << "D: " << found);
  BOOST_TEST(found == 2.0 * std::numbers::ln2, boost::test_tools::tolerance(0.05));
}

BOOST_AUTO_TEST_SUITE_END()
