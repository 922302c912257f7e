// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/walls/wall_heat_balance.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_walls_wall_heat_balance)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

/// s (T^4 - environment^4), odd below zero.
HeatLoss radiation(double s, double environment) {
  return {.flux = [=](double T) { return s * (std::copysign(std::pow(T, 4), T) - std::pow(environment, 4)); },
          .environment = environment};
}

BOOST_AUTO_TEST_CASE(a_linear_loss_gives_the_mean_weighted_by_conductances) {
  HeatLoss const loss{.flux = [](double T) { return 3.0 * (T - 0.5); }, .environment = 0.5};
  for (double const T : {-1.0, 0.5, 2.0, 1e6}) {
    BOOST_TEST(balanced_wall_temperature(loss, T, 7.0) == (7.0 * T + 3.0 * 0.5) / 10.0, tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE(what_reaches_the_wall_is_what_it_loses_hot_or_cold) {
  for (double const s : {1e-8, 1.0, 1e8}) {
    for (double const environment : {0.0, 0.7}) {
      HeatLoss const loss = radiation(s, environment);
      for (double const T : {-0.3, 0.0, 0.2, 1.0, 5.0}) {
        double const wall = balanced_wall_temperature(loss, T, 11.0);
        double const arriving = 11.0 * (T - wall);
        // Rounding of the wall's temperature counts by the slopes of both.
        double const slope = 11.0 + 4.0 * s * std::abs(std::pow(wall, 3));
        double const rounding =
            1e-14 * slope * (std::abs(wall) + std::abs(T)) + 1e-14 * s * std::pow(environment, 4);
        BOOST_TEST(std::abs(arriving - loss.flux(wall)) <= rounding, "s = " << s << ", T = " << T);
        BOOST_TEST(wall >= std::min(T, environment));
        BOOST_TEST(wall <= std::max(T, environment));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(limits_are_the_fluid_s_temperature_and_the_environment_s) {
  HeatLoss const loss = radiation(1.0, 0.7);
  BOOST_TEST(balanced_wall_temperature(loss, 2.0, 0.0) == 0.7);
  BOOST_TEST(balanced_wall_temperature(loss, 0.7, 3.0) == 0.7, tolerance(1e-15));
  BOOST_TEST(balanced_wall_temperature(loss, 2.0, 1e-12) == 0.7, tolerance(1e-10));
  BOOST_TEST(balanced_wall_temperature(loss, 2.0, 1e12) == 2.0, tolerance(1e-10));
}

BOOST_AUTO_TEST_CASE(temperatures_that_are_lost_give_no_number) {
  HeatLoss const loss = radiation(1.0, 0.7);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (double const T : {infinity, -infinity, std::nan(""), 1e200})
    BOOST_TEST(std::isnan(balanced_wall_temperature(loss, T, 1.0)));
}

/// Particles at random places beside a wall that radiates; only temperature and conductivity matter.
template <int Dim>
RandomScene<Dim> radiating_scene() {
  RandomScene<Dim> scene = random_scene<Dim>(7, Dim == 1 ? 20 : 80, {}, {});
  scene.walls.resize(1);
  scene.walls[0].heat_loss = radiation(1.3, 0.4);
  return scene;
}

template <int Dim>
WallContacts<Dim> filled(RandomScene<Dim> const& scene, BoundaryValueSet wanted, Closure closure) {
  WallContacts<Dim> contacts = geometry_of(scene).contacts[0];
  fill_boundary_values(contacts, scene.walls[0], scene.particles, wanted, closure, 0.0);
  return contacts;
}

constexpr BoundaryValueSet temperature_only{BoundaryValue::temperature};
constexpr BoundaryValueSet flux_only{BoundaryValue::flux};

BOOST_AUTO_TEST_CASE_TEMPLATE(a_temperature_linear_along_the_normal_shows_the_wall_its_own, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = radiating_scene<Dim>();
  Wall<Dim> const& wall = scene.walls[0];
  double const K = 0.7;
  double const wall_temperature = 1.6;
  double const loss = wall.heat_loss->flux(wall_temperature);
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    scene.particles.scalar(Field::conductivity)[i] = K;
    scene.particles.scalar(Field::temperature)[i] =
        wall_temperature + loss / K * wall.distance(scene.particles.positions()[i]);
  }
  for (Closure const closure : {Closure::quotient, Closure::one_sided}) {
    WallContacts<Dim> const hot = filled(scene, temperature_only, closure);
    WallContacts<Dim> const losing = filled(scene, flux_only, closure);
    BOOST_TEST_REQUIRE(hot.size() > 0u);
    BOOST_TEST(hot.prescribes_flux_only);
    for (std::size_t c = 0; c < hot.size(); ++c) {
      BOOST_TEST(hot.temperature[c] == wall_temperature, tolerance(1e-13));
      BOOST_TEST((losing.flux[c] - loss * wall.outward_normal).norm() < 1e-12 * loss);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(interpolated_temperature_distance_and_conductivity_enter_as_they_are, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = radiating_scene<Dim>();
  RandomScene<Dim> bare = scene;  // the same interpolations where nothing is prescribed
  bare.walls[0].heat_loss.reset();
  constexpr BoundaryValueSet both{BoundaryValue::temperature, BoundaryValue::conductivity};
  WallContacts<Dim> const inside = filled(bare, both, Closure::interpolated);
  for (std::size_t i = 0; i < bare.particles.size(); ++i)
    bare.particles.scalar(Field::temperature)[i] = bare.walls[0].distance(bare.particles.positions()[i]);
  WallContacts<Dim> const distance = filled(bare, temperature_only, Closure::interpolated);
  WallContacts<Dim> const found = filled(scene, flux_only, Closure::interpolated);
  for (std::size_t c = 0; c < found.size(); ++c) {
    double const arriving =
        inside.conductivity[c] * (inside.temperature[c] - found.temperature[c]) / distance.temperature[c];
    double const lost = scene.walls[0].heat_loss->flux(found.temperature[c]);
    BOOST_TEST(std::abs(arriving - lost) < 1e-11 * (1.0 + std::abs(lost)));
    BOOST_TEST(found.flux[c].dot(found.outward_normal) == lost, tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE(a_fluid_that_does_not_conduct_gives_a_losing_wall_nothing) {
  RandomScene<1> scene = radiating_scene<1>();
  scene.particles.scalar(Field::conductivity).assign(20, 0.0);
  WallContacts<1> const contacts = filled(scene, temperature_only, Closure::one_sided);
  BOOST_TEST_REQUIRE(contacts.size() > 0u);
  for (std::size_t c = 0; c < contacts.size(); ++c) BOOST_TEST(contacts.flux[c].norm() == 0.0);
}

// What the wall takes from a fine lattice is what it loses, as with a prescribed flux.
BOOST_AUTO_TEST_CASE(brookshaw_gives_the_wall_what_it_loses) {
  RandomScene<1> scene = lattice_scene<1>(400, 0.005, 20.0);
  scene.particles.scalar(Field::conductivity).assign(400, 1.0);
  scene.walls.push_back({.point = Vector<1>(-1.0), .outward_normal = Vector<1>(-1.0)});
  scene.walls[0].heat_loss = radiation(0.5, 0.0);
  double const loss = 0.5 * std::pow(1.2, 4);
  for (std::size_t i = 0; i < 400; ++i)
    scene.particles.scalar(Field::temperature)[i] = 1.2 + loss * (scene.particles.positions()[i][0] + 1.0);
  scene.closure = Closure::quotient;
  BOOST_TEST(evaluate(scene, "conduction/brookshaw").wall_power[0] == -loss, tolerance(1e-3));
}

BOOST_AUTO_TEST_SUITE_END()
