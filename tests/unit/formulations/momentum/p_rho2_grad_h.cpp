// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <optional>

#include "tests/support/own_lengths.hpp"

BOOST_AUTO_TEST_SUITE(formulations_momentum_p_rho2_grad_h)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "momentum/p-rho2-grad-h";

template <int Dim>
double share(dense::State<Dim> const& s, std::size_t i) {
  return s.P(i) / (s.rho(i) * s.rho(i) * s.Omega(i));
}

/// grad_i W(|r_i - r_j|, h), zero for j = i.
template <int Dim>
Vector<Dim> gradient(dense::State<Dim> const& s, std::size_t i, std::size_t j, double h) {
  Vector<Dim> const r = s.x(i) - s.x(j);
  return i == j ? Vector<Dim>::Zero() : Vector<Dim>(dense::slope<Dim>(r.norm(), h) * r / r.norm());
}

/// The header's equation.
/// @param h of each particle
/// @param seen_by the scene where all have the h of one, whose walls it sees
template <int Dim, class SeenBy>
std::vector<Vector<Dim>> equation(dense::State<Dim> const& s, std::vector<double> const& h, bool with_walls,
                                  SeenBy const& seen_by) {
  std::vector<Vector<Dim>> a(s.particles(), Vector<Dim>::Zero());
  for (std::size_t i = 0; i < s.particles(); ++i) {
    for (std::size_t j = 0; j < s.particles(); ++j)
      a[i] -= s.m(j) * (share(s, i) * gradient(s, i, j, h[i]) + share(s, j) * gradient(s, i, j, h[j]));
    if (!with_walls) continue;
    dense::State<Dim> const& at_walls = seen_by(i);
    for (std::size_t w = 0; w < s.walls(); ++w) {
      if (!at_walls.touches(i, w)) continue;
      double const rho_B = at_walls.rho(i, w);
      a[i] -= (at_walls.P(i, w) / (rho_B * rho_B) + share(s, i)) * rho_B * at_walls.S(i, w);
    }
  }
  return a;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation_where_all_have_one_h, D, Dimensions) {
  constexpr int Dim = D::value;
  double const deviation = dense::deviation<Dim>(id, [](dense::State<Dim> const& s, bool walls) {
    return equation(
        s, std::vector<double>(s.particles(), s.h()), walls, [&](std::size_t) -> auto const& { return s; });
  });
  BOOST_TEST(deviation < dense::round_off);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation_where_each_has_its_own_h, D, Dimensions) {
  constexpr int Dim = D::value;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    RandomScene<Dim> const scene = scene_of_own_lengths<Dim>(seed);
    for (bool const walls : {false, true}) {
      auto const found = evaluate(scene, id, geometry_of(scene, walls, PairSupport::larger)).acceleration;
      std::optional<RandomScene<Dim>> seen;
      std::optional<dense::State<Dim>> state;
      auto const expected = equation(
          dense::State<Dim>(scene), scene.particles.smoothing_lengths(), walls, [&](std::size_t i) -> auto const& {
            seen = as_seen_by(scene, i);
            return state.emplace(*seen);
          });
      BOOST_TEST(relative_difference(found, expected) < dense::round_off, "seed " << seed << ", walls " << walls);
      // Pairs that only the larger support holds are felt.
      auto const by_mean = evaluate(scene, id, geometry_of(scene, walls)).acceleration;
      BOOST_TEST(relative_difference(by_mean, expected) > 1e-4);
    }
  }
}

// Forces are minus the gradient of the internal energy at fixed entropies, smoothing lengths solved for anew at every place;
// those by the pair's mean h are not.
BOOST_AUTO_TEST_CASE_TEMPLATE(forces_are_minus_the_gradient_of_the_internal_energy, D, Dimensions) {
  constexpr int Dim = D::value;
  for (KernelInfo const& info : all_kernel_infos()) {
    Polytrope<Dim> const gas(kernel(info.id, Dim));
    std::vector<double> const& m = gas.scene.particles.masses();
    std::vector<Vector<Dim>> gradient;
    std::vector<Vector<Dim>> forces = gas.rates(id).acceleration, by_mean_h = gas.rates("momentum/p-rho2").acceleration;
    for (std::size_t i = 0; i < m.size(); ++i) {
      Vector<Dim> down;
      for (int k = 0; k < Dim; ++k) {
        auto const energy = [&](double step) {
          return gas.moved([&](std::size_t j) { return Vector<Dim>((j == i ? step : 0.0) * Vector<Dim>::Unit(k)); })
              .internal_energy();
        };
        down[k] = -slope_at_zero(energy, 1e-4);
      }
      gradient.push_back(down);
      forces[i] *= m[i];
      by_mean_h[i] *= m[i];
    }
    double const off = relative_difference(forces, gradient);
    double const mean_off = relative_difference(by_mean_h, gradient);
    BOOST_TEST_MESSAGE(Dim << "D, " << info.id << ": " << off << ", by the mean h " << mean_off);
    BOOST_TEST(off < 1e-5, info.id);  // third derivatives of splines jump
    BOOST_TEST(mean_off > 1e-2, info.id);
  }
}

BOOST_AUTO_TEST_SUITE_END()
