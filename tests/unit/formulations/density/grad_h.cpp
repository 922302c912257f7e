// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/density/grad_h.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "formulations/density/density.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/kernels.hpp"

BOOST_AUTO_TEST_SUITE(formulations_density_grad_h)

using namespace sphverify;
using namespace sphverify::tests;

/// Random particles whose smoothing lengths vary by a factor of two, independent of all else, between walls that meet.
template <int Dim>
RandomScene<Dim> varied_scene(Kernel const& kernel) {
  RandomScene<Dim> scene = random_scene<Dim>(kernel, 5);
  scene.particles.vary_smoothing_length();
  Random random(77);
  for (double& h : scene.particles.smoothing_lengths()) h *= random.uniform(0.6, 1.2);
  return scene;
}

/// rho_i by a double loop, were its smoothing length h.
template <int Dim>
double density_with(RandomScene<Dim> const& scene, std::size_t i, double h, bool normalised) {
  Kernel const& kernel = scene.particles.kernel();
  auto const& x = scene.particles.positions();
  double sum = 0.0;
  for (std::size_t j = 0; j < x.size(); ++j)
    sum += scene.particles.masses()[j] * written::kernel(kernel.id(), Dim, (x[i] - x[j]).norm(), h);
  return normalised ? sum / kernel_inside(x[i], scene.walls, h, kernel) : sum;
}

// Omega = 1 + h/(Dim rho) drho/dh by differences; the walls' part by differences of Gamma, not by face weights.
BOOST_AUTO_TEST_CASE_TEMPLATE(omega_is_what_its_definition_says_with_every_kernel, D, Dimensions) {
  constexpr int Dim = D::value;
  for (KernelInfo const& info : all_kernel_infos()) {
    RandomScene<Dim> scene = varied_scene<Dim>(kernel(info.id, Dim));
    auto const& lengths = scene.particles.smoothing_lengths();
    SmoothingLength const h(scene.particles);
    CellGrid<Dim> const grid(scene.particles.positions(), scene.domain, h.kernel().support_ratio() * h.largest());
    for (bool const normalised : {false, true}) {
      auto& density = scene.particles.scalar(Field::density);
      for (std::size_t i = 0; i < density.size(); ++i) density[i] = density_with(scene, i, lengths[i], normalised);
      std::vector<double> const omega =
          grad_h_terms(grid, h, scene.particles.masses(), density, normalised ? scene.walls : std::vector<Wall<Dim>>{}, 1);
      double worst = 0.0, farthest_from_one = 0.0;
      for (std::size_t i = 0; i < density.size(); ++i) {
        double const step = 1e-4 * lengths[i];
        double const slope =
            (density_with(scene, i, lengths[i] + step, normalised) - density_with(scene, i, lengths[i] - step, normalised)) /
            (2.0 * step);
        double const expected = 1.0 + lengths[i] / (Dim * density[i]) * slope;
        worst = std::max(worst, std::abs(omega[i] - expected));
        farthest_from_one = std::max(farthest_from_one, std::abs(expected - 1.0));
      }
      BOOST_TEST(worst < 1e-6, info.id << ", normalised " << normalised << ": " << worst);
      BOOST_TEST(farthest_from_one > 0.1);
      BOOST_TEST(same_bits(
          grad_h_terms(grid, h, scene.particles.masses(), density, normalised ? scene.walls : std::vector<Wall<Dim>>{}, 3),
          omega));
    }
  }
}

// Where Gamma takes part in it; a plain sum falls off towards a wall, and its Omega with it.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_uniform_gas_has_omega_one_up_to_its_walls_if_the_density_is_normalised, D, Dimensions) {
  constexpr int Dim = D::value;
  constexpr int side = Dim == 3 ? 11 : 13;
  RandomScene<Dim> scene = lattice_scene<Dim>(side, 0.1, Dim == 1 ? 2.0 : 1.6);
  scene.particles.vary_smoothing_length();
  for (double const sign : {-1.0, 1.0}) {
    for (int k = 0; k < Dim; ++k)
      scene.walls.push_back({.point = sign * scene.domain.upper, .outward_normal = sign * Vector<Dim>::Unit(k)});
  }
  SmoothingLength const h(scene.particles);
  CellGrid<Dim> const grid(scene.particles.positions(), scene.domain, h.support(0));
  std::vector<double> const& m = scene.particles.masses();
  auto const off = [&](std::vector<double> const& density, std::vector<Wall<Dim>> const& walls) {
    double worst = 0.0;
    for (double const omega : grad_h_terms(grid, h, m, density, walls, 1)) worst = std::max(worst, std::abs(omega - 1.0));
    return worst;
  };
  std::vector<double> density = summation_density(grid, h, m);
  BOOST_TEST(off(density, {}) > 0.2);
  for (std::size_t i = 0; i < density.size(); ++i)
    density[i] /= kernel_inside(scene.particles.positions()[i], scene.walls, h(i), h.kernel());
  BOOST_TEST_MESSAGE(Dim << "D: " << off(density, scene.walls));
  BOOST_TEST(off(density, scene.walls) < 0.06);
}

BOOST_AUTO_TEST_SUITE_END()
