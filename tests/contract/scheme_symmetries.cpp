// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(scheme_symmetries)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::size_t count = 60;
constexpr double round_off = 1e-10;

/// Random scenes in which walls prescribe all, a flux only, or nothing.
template <int Dim>
std::vector<RandomScene<Dim>> scenes() {
  std::vector<RandomScene<Dim>> list;
  list.push_back(random_scene<Dim>(11, count));
  list.push_back(random_scene<Dim>(12, count, {BoundaryValue::flux}, {}));
  list.push_back(random_scene<Dim>(13, count, {BoundaryValue::temperature}, {BoundaryValue::flux}));
  list.back().closure = Closure::one_sided;
  list.back().face_weight = FaceWeight::balanced;
  return list;
}

template <int Dim>
void check_covariance(Matrix<Dim> const& turn, Vector<Dim> const& shift) {
  for (RandomScene<Dim> const& scene : scenes<Dim>()) {
    RandomScene<Dim> const moved = transformed(scene, turn, shift);
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      Rates<Dim> expected = evaluate(scene, scheme->id);
      Rates<Dim> const found = evaluate(moved, scheme->id);
      for (auto* vectors : {&expected.acceleration, &expected.flux, &expected.wall_force}) {
        for (Vector<Dim>& v : *vectors) v = turn * v;
      }
      BOOST_TEST(relative_difference(found.acceleration, expected.acceleration) < round_off, scheme->id);
      BOOST_TEST(relative_difference(found.heating, expected.heating) < round_off, scheme->id);
      BOOST_TEST(relative_difference(found.flux, expected.flux) < round_off, scheme->id);
      BOOST_TEST(relative_difference(found.wall_force, expected.wall_force) < round_off, scheme->id);
      BOOST_TEST(relative_difference(found.wall_power, expected.wall_power) < round_off, scheme->id);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(moving_everything_changes_no_rate, D, Dimensions) {
  constexpr int Dim = D::value;
  Random random(1);
  check_covariance<Dim>(Matrix<Dim>::Identity(), random.vector<Dim>(-3.0, 3.0));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(turning_everything_turns_the_rates, D, Dimensions) {
  constexpr int Dim = D::value;
  Random random(2);
  check_covariance<Dim>(random.rotation<Dim>(), Vector<Dim>::Zero());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(mirroring_everything_mirrors_the_rates, D, Dimensions) {
  constexpr int Dim = D::value;
  Random random(3);
  check_covariance<Dim>(random.reflection<Dim>(), random.vector<Dim>(-1.0, 1.0));
}

template <int Dim>
RandomScene<Dim> boosted(RandomScene<Dim> scene, Vector<Dim> const& u) {
  for (std::size_t i = 0; i < scene.particles.size(); ++i) scene.particles.vector(Field::velocity).add(i, u);
  for (Wall<Dim>& wall : scene.walls) {
    if (!wall.velocity) continue;
    wall.velocity = [old = wall.velocity, u](Vector<Dim> const& x, double t) -> Vector<Dim> {
      return old(x, t) + u;
    };
  }
  return scene;
}

// The rate of total energy changes by exactly u.a: that of the kinetic energy of the boost.
BOOST_AUTO_TEST_CASE_TEMPLATE(common_velocity_changes_no_rate_but_that_of_total_energy, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = random_scene<Dim>(15, count);
  Vector<Dim> const u = Random(1).vector<Dim>(0.5, 2.0);
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    std::vector<double> expected = evaluate(scene, scheme->id).numbers();
    std::vector<double> const found = evaluate(boosted(scene, u), scheme->id).numbers();
    if (scheme->rate == Rate::total_work) {
      BOOST_TEST(relative_difference(found, expected) > 1e-2, scheme->id);
      auto const a = evaluate(scene, "momentum/p-rho2").acceleration;
      for (std::size_t i = 0; i < count; ++i) expected[i] += u.dot(a[i]);
    }
    BOOST_TEST(relative_difference(found, expected) < round_off, scheme->id);
  }
}

// Eq. 74 does not return a constant exactly, so that a wall of interpolated velocity has a velocity of its
// own.
BOOST_AUTO_TEST_CASE_TEMPLATE(common_velocity_is_felt_at_a_wall_of_interpolated_velocity, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = random_scene<Dim>(15, count, {BoundaryValue::pressure}, {BoundaryValue::pressure});
  Vector<Dim> const u = Random(1).vector<Dim>(0.5, 2.0);
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    if (scheme->rate != Rate::internal_work) continue;
    double const change = relative_difference(evaluate(boosted(scene, u), scheme->id).numbers(),
                                              evaluate(scene, scheme->id).numbers());
    BOOST_TEST(change > 1e-3, scheme->id);
  }
}

template <int Dim>
RandomScene<Dim> warmer(RandomScene<Dim> scene, double shift) {
  for (double& T : scene.particles.scalar(Field::temperature)) T += shift;
  for (Wall<Dim>& wall : scene.walls) {
    if (!wall.temperature) continue;
    wall.temperature = [old = wall.temperature, shift](Vector<Dim> const& x, double t) {
      return old(x, t) + shift;
    };
  }
  return scene;
}

// On disordered particles a uniform temperature drives spurious fluxes in the two-pass forms.
BOOST_AUTO_TEST_CASE_TEMPLATE(zero_of_temperature_matters_to_forms_that_are_not_steady_on_disorder_only, D, Dimensions) {
  constexpr int Dim = D::value;
  for (bool const walls : {false, true}) {
    RandomScene<Dim> scene = lattice_scene<Dim>(Dim == 3 ? 9 : 12, 0.1, 1.2);
    Random random(16);
    std::vector<double> const mass = scene.particles.masses();
    randomise_fields(scene.particles, random);
    scene.particles.masses() = mass;
    scene.particles.scalar(Field::density).assign(mass.size(), 1.0);
    for (std::size_t i = 0; i < mass.size(); ++i) {
      scene.particles.positions().add(i, random.vector<Dim>(-0.01, 0.01));  // 0.1 dx
    }
    scene.walls.push_back({.point = scene.domain.upper, .outward_normal = Vector<Dim>::Unit(0)});
    prescribe(scene.walls[0], no_flux, random);
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      if (scheme->rate != Rate::conduction_heating) continue;
      double const change = relative_difference(evaluate(warmer(scene, 1.0), scheme->id, walls).heating,
                                                evaluate(scene, scheme->id, walls).heating);
      BOOST_TEST_MESSAGE(Dim << "D " << scheme->id << ", walls " << walls << ": relative change " << change);
      if (!scheme->claims.steady_on_any_particles)
        BOOST_TEST(change > 0.01, scheme->id);
      else
        BOOST_TEST(change < (scheme->needs_partners ? 1e-11 : 1e-13), scheme->id);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
