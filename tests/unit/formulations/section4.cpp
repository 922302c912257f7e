// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "formulations/kernels/cubic_spline.hpp"
#include "tests/support/gathered_pairs.hpp"
#include "tests/support/random_particles.hpp"

// Section 4 of the report: what the particle equations are as finite differences, for equally spaced
// particles of equal mass with h = dx. Its text says that W = 1/(2h) at 0.6 h from the wall; by its own Eq.
// 24 W(0.6 h) is 0.4147/h and W = 1/(2h) falls at 0.4662 h, which is where the wall stands below.
BOOST_AUTO_TEST_SUITE(formulations_section4)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

constexpr double h = 0.05;
constexpr double rho = 1.3;
constexpr int count = 20;

/// Equally spaced particles of uniform given density and arbitrary pressures, the last of them at x = 9.5 h.
RandomScene<1> line() {
  RandomScene<1> scene = lattice_scene<1>(count, h, 1.0);
  Random random(4);
  for (std::size_t i = 0; i < count; ++i) {
    scene.particles.masses()[i] = rho * h;
    scene.particles.scalar(Field::density)[i] = rho;
    scene.particles.scalar(Field::pressure)[i] = random.uniform(0.5, 2.0);
  }
  return scene;
}

/// Where W(d) = 1/(2h), in h.
double half_over_h() {
  double near = 0.0;
  double far = 1.0;
  for (int n = 0; n < 60; ++n) {
    double const middle = 0.5 * (near + far);
    (CubicSpline<1>::value(middle * h, h) > 0.5 / h ? near : far) = middle;
  }
  return near;
}

constexpr double wall_pressure = 1.7;

RandomScene<1> line_to_a_wall() {
  RandomScene<1> scene = line();
  scene.walls.push_back({.point = Vector<1>(9.5 * h + half_over_h() * h), .outward_normal = Vector<1>(1.0)});
  scene.walls[0].pressure = [](Vector<1> const&, double) { return wall_pressure; };
  return scene;
}

BOOST_AUTO_TEST_CASE(equation_27_slope_of_the_kernel_at_the_two_neighbours) {
  RandomScene<1> const scene = line();
  PairGeometry<1> const geometry = geometry_of(scene, false);
  GatheredPairs<1> const pairs = gathered_pairs(scene.particles, geometry);
  auto const& list = geometry.neighbours;
  for (std::size_t i = 1; i + 1 < count; ++i) {
    for (std::size_t k = list.first[i]; k < list.first[i + 1]; ++k) {
      double const slope = pairs.gradient(k)[0];
      if (list.neighbour[k] + 1 == i)
        BOOST_TEST(slope == -0.5 / (h * h), tolerance(1e-12));
      else if (list.neighbour[k] == i + 1)
        BOOST_TEST(slope == 0.5 / (h * h), tolerance(1e-12));
      else
        BOOST_TEST(std::abs(slope) < 1e-12 / (h * h));  // 2 h away, to round-off
    }
  }
}

BOOST_AUTO_TEST_CASE(equations_26_and_28_central_difference_far_from_any_wall) {
  RandomScene<1> const scene = line();
  auto const& P = scene.particles.scalar(Field::pressure);
  auto const a = evaluate(scene, "momentum/p-rho2").acceleration;
  for (std::size_t i = 1; i + 1 < count; ++i) {
    BOOST_TEST(a[i][0] == -0.5 / h * (P[i + 1] / rho - P[i - 1] / rho), tolerance(1e-10));
  }
}

// The density at the wall is twice the kernel sum there: W at 0.4662 h and 1.4662 h.
BOOST_AUTO_TEST_CASE(equation_29_at_a_wall_where_w_is_half_over_h) {
  RandomScene<1> const scene = line_to_a_wall();
  auto const& P = scene.particles.scalar(Field::pressure);
  double const s = half_over_h();
  BOOST_TEST(s == 0.46618, tolerance(1e-4));
  double const rho_X = 2.0 * rho * (0.5 + std::pow(1.0 - s, 3) / 6.0);
  auto const over_square = [](double pressure, double density) { return pressure / (density * density); };
  double const own = over_square(P[19], rho);
  double const expected = -(over_square(wall_pressure, rho_X) + own) * rho_X * 0.5 / h -
                          rho * h * (over_square(P[18], rho) + own) * (-0.5 / (h * h));
  BOOST_TEST(evaluate(scene, "momentum/p-rho2").acceleration[19][0] == expected, tolerance(1e-10));
}

// Eq. 30 takes the density at the wall for that of the fluid, where the kernel sum gives 5% more.
BOOST_AUTO_TEST_CASE(equation_30_central_difference_between_the_wall_and_the_particle_before) {
  RandomScene<1> scene = line_to_a_wall();
  auto const& P = scene.particles.scalar(Field::pressure);
  PairGeometry<1> geometry = geometry_of(scene);
  BOOST_TEST(geometry.contacts[0].foot_density.back() == 1.0505 * rho, tolerance(1e-3));
  for (double& density : geometry.contacts[0].foot_density) density = rho;
  WorkCount work;
  make_rate_operator<1>("momentum/p-rho2")
      ->evaluate(scene.particles, geometry, Closure::interpolated, 0.0, 1, work);
  double const expected = -0.5 / h * (wall_pressure / rho - P[18] / rho);
  BOOST_TEST(scene.particles.vector(Field::acceleration)[19][0] == expected, tolerance(1e-10));
}

BOOST_AUTO_TEST_SUITE_END()
