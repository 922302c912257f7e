// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "formulations/density/density.hpp"
#include "formulations/density/grad_h.hpp"
#include "formulations/density/self_consistent_smoothing.hpp"
#include "tests/support/dense.hpp"

// Particles with smoothing lengths of their own, for forms that take the kernel by either.
namespace sphverify::tests {

/// Random particles between two walls whose smoothing lengths vary by a factor of two, independent of all else.
template <int Dim>
RandomScene<Dim> scene_of_own_lengths(std::uint64_t seed) {
  RandomScene<Dim> scene = random_scene<Dim>(seed, Dim == 1 ? 40 : (Dim == 2 ? 60 : 90));
  scene.particles.vary_smoothing_length();
  Random random(seed + 77);
  for (double& h : scene.particles.smoothing_lengths()) h *= random.uniform(0.6, 1.2);
  return scene;
}

/// The same scene where all have the smoothing length of one: what that particle sees of walls.
template <int Dim>
RandomScene<Dim> as_seen_by(RandomScene<Dim> const& scene, std::size_t i) {
  RandomScene<Dim> seen = scene;
  Particles<Dim> const& p = scene.particles;
  seen.particles = Particles<Dim>(p.size(), p.smoothing_lengths()[i]);
  seen.particles.set_kernel(p.kernel());
  for (Field const field : {Field::mass, Field::density, Field::pressure, Field::temperature, Field::conductivity}) {
    seen.particles.allocate(field);
    seen.particles.scalar(field) = p.scalar(field);
  }
  seen.particles.allocate(Field::velocity);
  seen.particles.vector(Field::velocity) = p.vector(Field::velocity);
  seen.particles.positions() = p.positions();
  return seen;
}

/// Particles in the open, jittered about a lattice, of unlike masses and entropies K, P = K rho^gamma; smoothing lengths,
/// densities and what follows from them are solved for where they are.
template <int Dim>
struct Polytrope {
  static constexpr double gamma = 1.4, ratio = 1.3;
  static constexpr int side = Dim == 1 ? 14 : (Dim == 2 ? 6 : 4);

  RandomScene<Dim> scene = lattice_scene<Dim>(side, 1.0 / side, ratio);
  std::vector<double> entropy;

  explicit Polytrope(Kernel const& kernel) {
    Random random(9);
    Particles<Dim>& p = scene.particles;
    p.set_kernel(kernel);
    p.vary_smoothing_length();
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.positions().add(i, random.vector<Dim>(-0.25, 0.25) / side);
      p.masses()[i] *= random.uniform(0.6, 1.4);
      p.vector(Field::velocity).set(i, random.vector<Dim>(-1.0, 1.0));
      entropy.push_back(random.uniform(0.5, 2.0));
    }
    solve();
  }

  void solve() {
    Particles<Dim>& p = scene.particles;
    std::vector<Wall<Dim>> const none;
    SelfConsistentSmoothing<Dim>{p.positions(), p.masses(), scene.domain, none, ratio, 1, p.kernel()}.solve(
        p.smoothing_lengths());
    SmoothingLength const h(p);
    CellGrid<Dim> const grid(p.positions(), scene.domain, h.kernel().support_ratio() * h.largest());
    p.scalar(Field::density) = summation_density(grid, h, p.masses());
    p.scalar(Field::omega) = grad_h_terms(grid, h, p.masses(), p.scalar(Field::density), none, 1);
    for (std::size_t i = 0; i < p.size(); ++i)
      p.scalar(Field::pressure)[i] = entropy[i] * std::pow(p.scalar(Field::density)[i], gamma);
  }

  /// The gas after it has moved.
  template <class Displacement>
  Polytrope moved(Displacement const& by) const {
    Polytrope other = *this;
    for (std::size_t i = 0; i < entropy.size(); ++i) other.scene.particles.positions().add(i, by(i));
    other.solve();
    return other;
  }

  double internal_energy() const {
    Particles<Dim> const& p = scene.particles;
    double sum = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i)
      sum += p.masses()[i] * p.scalar(Field::pressure)[i] / ((gamma - 1.0) * p.scalar(Field::density)[i]);
    return sum;
  }

  Rates<Dim> rates(std::string_view id) const { return evaluate(scene, id, geometry_of(scene, false, PairSupport::larger)); }
};

/// f'(0) by differences of fourth order.
template <class Function>
double slope_at_zero(Function const& f, double step) {
  return (8.0 * (f(step) - f(-step)) - (f(2.0 * step) - f(-2.0 * step))) / (12.0 * step);
}

}  // namespace sphverify::tests
