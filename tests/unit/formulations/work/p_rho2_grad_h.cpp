// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <optional>

#include "tests/support/own_lengths.hpp"

BOOST_AUTO_TEST_SUITE(formulations_work_p_rho2_grad_h)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "work/p-rho2-grad-h";

/// The header's equation.
/// @param h of each particle
/// @param seen_by the scene where all have the h of one, whose walls it sees
template <int Dim, class SeenBy>
std::vector<double> equation(dense::State<Dim> const& s, std::vector<double> const& h, bool with_walls, SeenBy const& seen_by) {
  std::vector<double> rate(s.particles(), 0.0);
  for (std::size_t i = 0; i < s.particles(); ++i) {
    double const share = s.P(i) / (s.rho(i) * s.rho(i) * s.Omega(i));
    for (std::size_t j = 0; j < s.particles(); ++j) {
      if (j == i) continue;
      Vector<Dim> const r = s.x(i) - s.x(j);
      rate[i] += share * s.m(j) * (s.v(i) - s.v(j)).dot(r) / r.norm() * dense::slope<Dim>(r.norm(), h[i]);
    }
    if (!with_walls) continue;
    dense::State<Dim> const& at_walls = seen_by(i);
    for (std::size_t w = 0; w < s.walls(); ++w) {
      if (at_walls.touches(i, w)) rate[i] += share * at_walls.rho(i, w) * (s.v(i) - at_walls.v(i, w)).dot(at_walls.S(i, w));
    }
  }
  return rate;
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
      auto const found = evaluate(scene, id, geometry_of(scene, walls, PairSupport::larger)).heating;
      std::optional<RandomScene<Dim>> seen;
      std::optional<dense::State<Dim>> state;
      auto const expected = equation(
          dense::State<Dim>(scene), scene.particles.smoothing_lengths(), walls, [&](std::size_t i) -> auto const& {
            seen = as_seen_by(scene, i);
            return state.emplace(*seen);
          });
      BOOST_TEST(relative_difference(found, expected) < dense::round_off, "seed " << seed << ", walls " << walls);
    }
  }
}

// Each particle keeps its entropy: the heating is P/rho^2 times the rate of a density whose smoothing length is solved for anew
// at every place; that of the partner of p-rho2 is not.
BOOST_AUTO_TEST_CASE_TEMPLATE(heating_is_that_of_the_density_which_its_h_follows, D, Dimensions) {
  constexpr int Dim = D::value;
  for (KernelInfo const& info : all_kernel_infos()) {
    Polytrope<Dim> const gas(kernel(info.id, Dim));
    Particles<Dim> const& p = gas.scene.particles;
    auto const densities = [&](double time) {
      return gas.moved([&](std::size_t i) { return Vector<Dim>(time * p.vector(Field::velocity)[i]); })
          .scene.particles.scalar(Field::density);
    };
    double const step = 1e-4;
    std::vector<double> const later = densities(step), sooner = densities(-step), latest = densities(2.0 * step),
                              soonest = densities(-2.0 * step);
    std::vector<double> expected;
    for (std::size_t i = 0; i < p.size(); ++i) {
      double const rho = p.scalar(Field::density)[i];
      double const rate = (8.0 * (later[i] - sooner[i]) - (latest[i] - soonest[i])) / (12.0 * step);
      expected.push_back(p.scalar(Field::pressure)[i] / (rho * rho) * rate);
    }
    double const off = relative_difference(gas.rates(id).heating, expected);
    double const mean_off = relative_difference(gas.rates("work/internal-energy").heating, expected);
    BOOST_TEST_MESSAGE(Dim << "D, " << info.id << ": " << off << ", by the mean h " << mean_off);
    BOOST_TEST(off < 1e-5, info.id);  // third derivatives of splines jump
    BOOST_TEST(mean_off > 1e-2, info.id);
  }
}

// With the partner's force the wall's power is half of P_B v_i and half of P_i v_B, each over its own square of density.
BOOST_AUTO_TEST_CASE_TEMPLATE(power_of_a_wall_is_what_both_forms_say_of_it, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = scene_of_own_lengths<Dim>(4);
  PairGeometry<Dim> const geometry = geometry_of(scene, true, PairSupport::larger);
  Rates<Dim> const momentum = evaluate(scene, "momentum/p-rho2-grad-h", geometry);
  Rates<Dim> const work = evaluate(scene, id, geometry);
  Rates<Dim> const no_walls = evaluate(scene, "momentum/p-rho2-grad-h", geometry_of(scene, false, PairSupport::larger));
  double power = work.wall_power[0] + work.wall_power[1], expected = 0.0;
  Particles<Dim> const& p = scene.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    power += p.masses()[i] * p.vector(Field::velocity)[i].dot(momentum.acceleration[i] - no_walls.acceleration[i]);
  for (std::size_t w = 0; w < 2; ++w) {
    WallContacts<Dim> const& contacts = geometry.contacts[w];
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      std::size_t const i = contacts.particle[c];
      Vector<Dim> const S = contacts.face_weight[c] * scene.walls[w].outward_normal;
      Vector<Dim> const foot = contacts.foot[c];
      double const P_B = scene.walls[w].pressure(foot, scene.time), rho_B = contacts.foot_density[c];
      double const share =
          p.scalar(Field::pressure)[i] / (p.scalar(Field::density)[i] * p.scalar(Field::density)[i] * p.scalar(Field::omega)[i]);
      expected -=
          p.masses()[i] * rho_B *
          (P_B / (rho_B * rho_B) * p.vector(Field::velocity)[i] + share * scene.walls[w].velocity(foot, scene.time)).dot(S);
    }
  }
  BOOST_TEST(power == expected, boost::test_tools::tolerance(1e-11));
}

BOOST_AUTO_TEST_SUITE_END()
