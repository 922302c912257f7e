// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/wall_particles/mirror.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "formulations/density/density.hpp"
#include "formulations/rate_operator.hpp"
#include "formulations/viscosity/viscosity.hpp"
#include "tests/support/cell_scenes.hpp"

BOOST_AUTO_TEST_SUITE(formulations_wall_particles_mirror)

using namespace sphverify;
using namespace sphverify::tests;

constexpr double length = 0.13;  // of smoothing

/// Particles in a box of walls with mirrors behind these; and the same particles with all their reflections, one box in each
/// direction, in a periodic box twice as large, where there are no walls at all.
template <int Dim>
struct Mirrored {
  Domain<Dim> domain, doubled;
  Particles<Dim> particles{0, 1.0}, all{0, 1.0};
  PairGeometry<Dim> geometry, periodic;

  /// @param odd whether temperatures turn round in walls, which prescribe 0, or are insulated
  explicit Mirrored(bool odd) {
    domain = {.lower = Vector<Dim>::Zero(), .upper = Vector<Dim>::Ones()};
    doubled = {.lower = -Vector<Dim>::Ones(), .upper = Vector<Dim>::Ones()};
    doubled.periodic.fill(true);
    VectorField<Dim> const places = jittered(domain, Dim == 1 ? 20 : Dim == 2 ? 8 : 6, 0.3, 4).positions;
    std::size_t const n = places.size();
    std::size_t constexpr copies = 1u << Dim;
    particles = Particles<Dim>(n, length);
    all = Particles<Dim>(copies * n, length);
    particles.positions() = places;
    FieldSet const fields{Field::density, Field::pressure, Field::velocity, Field::temperature, Field::conductivity, Field::sound_speed,
                          Field::acceleration, Field::heating, Field::density_rate};
    particles.allocate(fields);
    all.allocate(fields);
    Random random(8);
    for (std::size_t i = 0; i < n; ++i) {
      particles.masses()[i] = random.uniform(0.5, 2.0);
      for (Field const field : {Field::density, Field::pressure, Field::temperature, Field::conductivity, Field::sound_speed})
        particles.scalar(field)[i] = random.uniform(0.5, 2.0);
      particles.vector(Field::velocity).set(i, random.vector<Dim>(-1.0, 1.0));
    }
    for (std::size_t copy = 0; copy < copies; ++copy) {
      for (std::size_t i = 0; i < n; ++i) {
        std::size_t const to = copy * n + i;
        Vector<Dim> x = particles.positions()[i];
        Vector<Dim> v = particles.vector(Field::velocity)[i];
        double T = particles.scalar(Field::temperature)[i];
        for (int k = 0; k < Dim; ++k) {
          if (((copy >> k) & 1u) == 0) continue;
          x[k] = -x[k];
          v[k] = -v[k];
          if (odd) T = -T;
        }
        all.positions().set(to, x);
        all.vector(Field::velocity).set(to, v);
        all.masses()[to] = particles.masses()[i];
        for (Field const field : {Field::density, Field::pressure, Field::conductivity, Field::sound_speed})
          all.scalar(field)[to] = particles.scalar(field)[i];
        all.scalar(Field::temperature)[to] = T;
      }
    }
    geometry.domain = domain;
    geometry.walls = walls_of(domain);
    for (Wall<Dim>& wall : geometry.walls) {
      wall.velocity = [](Vector<Dim> const&, double) { return Vector<Dim>::Zero().eval(); };
      if (odd) {
        wall.temperature = [](Vector<Dim> const&, double) { return 0.0; };
        wall.conductivity = [](Vector<Dim> const&, double) { return 1.0; };
      } else {
        wall.flux = [](Vector<Dim> const&, double) { return Vector<Dim>::Zero().eval(); };
      }
    }
    SmoothingLength const h(particles);
    CellGrid<Dim> const grid(particles.positions(), domain, h.support(0));
    geometry.neighbours = find_neighbours(grid);
    for (Wall<Dim> const& wall : geometry.walls)
      geometry.contacts.push_back(find_wall_contacts(grid, wall, geometry.walls, h, particles.masses(),
                                                     particles.scalar(Field::density), FaceWeight::exact));
    geometry.behind = stand_behind_walls(MirrorWalls::place<Dim>({particles, domain, geometry.walls, grid, 0.1}), geometry.contacts,
                                         particles, domain);
    periodic.domain = doubled;
    periodic.neighbours = find_neighbours(CellGrid<Dim>(all.positions(), doubled, h.support(0)));
  }
};

template <int Dim>
double largest(std::vector<double> const& values, std::size_t count) {
  double most = 0.0;
  for (std::size_t i = 0; i < count; ++i) most = std::max(most, std::abs(values[i]));
  return most;
}

/// Every scheme, whatever its passes: with images behind the walls it gives what it gives without walls.
BOOST_AUTO_TEST_CASE_TEMPLATE(mirrors_are_a_periodic_box_of_reflections, D, Dimensions) {
  constexpr int Dim = D::value;
  enum class Given { temperature, flux, nothing };
  for (Given const given : {Given::temperature, Given::flux, Given::nothing}) {
    bool const odd = given == Given::temperature;
    for (SchemeInfo const* const info : all_scheme_infos()) {
      // What is not linear in temperature does not turn round with it; a gas has no walls of temperature.
      if (odd && info->rate != Rate::conduction_heating) continue;
      if (reads_face_offsets(*info)) continue;  // cells end at walls
      Mirrored<Dim> scene(odd);
      if (given == Given::nothing) {
        for (Wall<Dim>& wall : scene.geometry.walls) wall.flux = {};
        for (WallContacts<Dim>& contacts : scene.geometry.contacts) contacts.prescribes_flux_only = false;
      }
      auto const scheme = make_rate_operator<Dim>(info->id);
      scene.particles.allocate(needed_fields(*info));
      scene.all.allocate(needed_fields(*info));
      for (Particles<Dim>* const particles : {&scene.particles, &scene.all}) {
        if (particles->has(Field::omega)) particles->scalar(Field::omega).assign(particles->size(), 1.1);
      }
      WorkCount work;
      scheme->evaluate(scene.particles, scene.geometry, Closure::interpolated, 0.0, 2, work);
      make_rate_operator<Dim>(info->id)->evaluate(scene.all, scene.periodic, Closure::interpolated, 0.0, 1, work);
      std::size_t const n = scene.particles.size();
      double worst = 0.0;
      double size = 0.0;
      auto const compare = [&](std::vector<double> const& with_images, std::vector<double> const& periodic) {
        for (std::size_t i = 0; i < n; ++i) {
          worst = std::max(worst, std::abs(with_images[i] - periodic[i]));
          size = std::max(size, std::abs(periodic[i]));
        }
      };
      if (info->rate == Rate::acceleration) {
        for (int k = 0; k < Dim; ++k)
          compare(scene.particles.vector(Field::acceleration).component(k), scene.all.vector(Field::acceleration).component(k));
      } else {
        compare(scene.particles.scalar(Field::heating), scene.all.scalar(Field::heating));
      }
      BOOST_TEST(size > 0.1);
      BOOST_TEST(worst < (info->least_squares ? 1e-11 : 1e-12) * size, info->id << (odd ? ", odd" : ", even") << ": " << worst / size);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(so_are_viscosity_continuity_and_summed_density, D, Dimensions) {
  constexpr int Dim = D::value;
  Mirrored<Dim> scene(false);
  std::size_t const n = scene.particles.size();
  Viscosity const viscosity = MonaghanViscosity{1.0, 2.0};
  auto const rubbed = [&](Particles<Dim>& particles, PairGeometry<Dim>& geometry) {
    ViscousRates<Dim> rates;
    PairSweep<Dim> sweep(geometry.neighbours, geometry.domain, 1);
    add_viscosity(viscosity, particles, sweep, rates);
    sweep.run(particles);
    add_viscous_walls(viscosity, particles, geometry, Closure::interpolated, 0.5, 0.0, 1, rates);
    return rates;
  };
  ViscousRates<Dim> const images = rubbed(scene.particles, scene.geometry);
  ViscousRates<Dim> const periodic = rubbed(scene.all, scene.periodic);
  double const heat = largest<Dim>(periodic.heating, n);
  for (std::size_t i = 0; i < n; ++i) {
    BOOST_TEST(std::abs(images.heating[i] - periodic.heating[i]) < 1e-12 * heat);
    BOOST_TEST((images.acceleration[i] - periodic.acceleration[i]).norm() < 1e-11 * heat);
    BOOST_TEST(std::abs(images.largest_mu[i] - periodic.largest_mu[i]) < 1e-13);
  }
  // Walls at rest give no energy but what they stop: what all of it does to the gas is booked to them.
  double power = 0.0;
  double booked = 0.0;
  Vector<Dim> force = Vector<Dim>::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    power += scene.particles.masses()[i] *
             (images.heating[i] + images.acceleration[i].dot(scene.particles.vector(Field::velocity)[i]));
    force += scene.particles.masses()[i] * images.acceleration[i];
  }
  for (double const one : images.wall_power) booked += one;
  for (Vector<Dim> const& one : images.wall_force) force -= one;
  BOOST_TEST(std::abs(power - booked) < 1e-11 * static_cast<double>(n) * heat);
  BOOST_TEST(force.norm() < 1e-11 * static_cast<double>(n) * heat);

  auto const continuity = make_continuity_operator<Dim>();
  WorkCount work;
  continuity->evaluate(scene.particles, scene.geometry, Closure::interpolated, 0.0, 1, work);
  continuity->evaluate(scene.all, scene.periodic, Closure::interpolated, 0.0, 1, work);
  double const rate = largest<Dim>(scene.all.scalar(Field::density_rate), n);
  for (std::size_t i = 0; i < n; ++i)
    BOOST_TEST(std::abs(scene.particles.scalar(Field::density_rate)[i] - scene.all.scalar(Field::density_rate)[i]) < 1e-12 * rate);

  sum_density(scene.particles, scene.geometry.neighbours, scene.domain, 1);
  sum_density(scene.all, scene.periodic.neighbours, scene.doubled, 1);
  std::vector<double> density = scene.particles.scalar(Field::density);
  for (std::size_t w = 0; w < scene.geometry.walls.size(); ++w) {
    fill_wall_particles(scene.geometry.behind[w], scene.geometry.contacts[w], scene.geometry.walls, scene.particles, {Field::mass}, 0.0);
    add_density_behind(scene.geometry.behind[w], scene.geometry.contacts[w], scene.domain, 1, density);
  }
  for (std::size_t i = 0; i < n; ++i) BOOST_TEST(std::abs(density[i] / scene.all.scalar(Field::density)[i] - 1.0) < 1e-13);
}

/// What images give is what the walls' budgets say.
BOOST_AUTO_TEST_CASE_TEMPLATE(budgets_book_what_images_exchange, D, Dimensions) {
  constexpr int Dim = D::value;
  Mirrored<Dim> scene(true);
  WorkCount work;
  auto const push = make_rate_operator<Dim>("momentum/p-rho2");
  push->evaluate(scene.particles, scene.geometry, Closure::interpolated, 0.0, 1, work);
  Vector<Dim> force = Vector<Dim>::Zero();
  double size = 0.0;
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    Vector<Dim> const one = scene.particles.masses()[i] * scene.particles.vector(Field::acceleration)[i];
    force += one;
    size += one.norm();
  }
  for (std::size_t w = 0; w < scene.geometry.walls.size(); ++w) {
    force -= push->wall_force()[w];
    // A wall pushes the gas inwards.
    BOOST_TEST(push->wall_force()[w].dot(scene.geometry.walls[w].outward_normal) < 0.0);
  }
  BOOST_TEST(force.norm() < 1e-13 * size);
  auto const heat = make_rate_operator<Dim>("conduction/brookshaw");
  heat->evaluate(scene.particles, scene.geometry, Closure::interpolated, 0.0, 1, work);
  double power = 0.0;
  size = 0.0;
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    double const one = scene.particles.masses()[i] * scene.particles.scalar(Field::heating)[i];
    power += one;
    size += std::abs(one);
  }
  for (double const one : heat->wall_power()) {
    power -= one;
    BOOST_TEST(one < 0.0);  // all walls are colder than anything inside
  }
  BOOST_TEST(std::abs(power) < 1e-13 * size);
}

/// Images stand where mirrors put them, images of images in corners; values are continued about what walls prescribe there,
/// so that linear fields go on as they are.
BOOST_AUTO_TEST_CASE_TEMPLATE(linear_fields_go_on_behind_walls_and_beyond_corners, D, Dimensions) {
  constexpr int Dim = D::value;
  Mirrored<Dim> scene(true);
  Vector<Dim> slope;
  for (int k = 0; k < Dim; ++k) slope[k] = 1.0 + k;
  auto const T = [slope](Vector<Dim> const& x) { return 2.0 + slope.dot(x); };
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    scene.particles.scalar(Field::temperature)[i] = T(scene.particles.positions()[i]);
    scene.particles.scalar(Field::pressure)[i] = T(scene.particles.positions()[i]);
    scene.particles.scalar(Field::conductivity)[i] = 1.6;
  }
  scene.particles.allocate(Field::flux);
  for (std::size_t i = 0; i < scene.particles.size(); ++i) scene.particles.vector(Field::flux).set(i, -1.6 * slope);
  std::size_t most_mirrors = 0;
  for (bool const by_flux : {false, true}) {
    for (Wall<Dim>& wall : scene.geometry.walls) {
      wall.temperature = {};
      wall.flux = {};
      if (by_flux) {
        wall.flux = [slope](Vector<Dim> const&, double) { return (-1.6 * slope).eval(); };
      } else {
        wall.temperature = [T](Vector<Dim> const& foot, double) { return T(foot); };
      }
      wall.pressure = [T](Vector<Dim> const& foot, double) { return T(foot); };
    }
    for (std::size_t w = 0; w < scene.geometry.walls.size(); ++w) {
      WallParticles<Dim>& behind = scene.geometry.behind[w];
      fill_wall_particles(behind, scene.geometry.contacts[w], scene.geometry.walls, scene.particles,
                          {Field::temperature, Field::pressure, Field::flux}, 0.0);
      for (std::size_t k = 0; k < behind.placed.size(); ++k) {
        std::size_t const at = scene.geometry.contacts[w].size() + k;
        Vector<Dim> const x = behind.particles.positions()[at];
        BOOST_TEST(std::abs(behind.particles.scalar(Field::temperature)[at] - T(x)) < 1e-13 * 10.0);
        BOOST_TEST(std::abs(behind.particles.scalar(Field::pressure)[at] - T(x)) < 1e-13 * 10.0);
        BOOST_TEST((behind.particles.vector(Field::flux)[at] + 1.6 * slope).norm() < 1e-9);
        // Booked to the wall behind which it is farthest, by the distances themselves.
        for (Wall<Dim> const& other : scene.geometry.walls) BOOST_TEST(other.distance(x) >= scene.geometry.walls[w].distance(x) - 1e-14);
        BOOST_TEST(scene.geometry.walls[w].distance(x) < 0.0);
        most_mirrors = std::max(most_mirrors, static_cast<std::size_t>(behind.placed[k].mirror_count));
      }
    }
  }
  BOOST_TEST(most_mirrors == static_cast<std::size_t>(Dim));
}

/// A wall that radiates has the temperature at which as much reaches it as it loses.
BOOST_AUTO_TEST_CASE(a_wall_that_loses_heat_is_mirrored_at_its_own_temperature) {
  Mirrored<1> scene(true);
  double const K = 2.0;
  for (Wall<1>& wall : scene.geometry.walls) {
    wall.temperature = {};
    wall.heat_loss = HeatLoss{.flux = [](double T) { return 3.0 * T; }, .environment = 0.0};
  }
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    scene.particles.scalar(Field::temperature)[i] = 1.0 + 0.1 * static_cast<double>(i);
    scene.particles.scalar(Field::conductivity)[i] = K;
  }
  WallParticles<1>& behind = scene.geometry.behind[0];
  fill_wall_particles(behind, scene.geometry.contacts[0], scene.geometry.walls, scene.particles, {Field::temperature}, 0.0);
  BOOST_TEST_REQUIRE(!behind.placed.empty());
  for (std::size_t k = 0; k < behind.placed.size(); ++k) {
    auto const& one = behind.placed[k];
    double const T = scene.particles.scalar(Field::temperature)[one.sources[0].first];
    double const d = one.mirrors[0].inside;
    double const wall = T * (K / d) / (K / d + 3.0);  // K (T - T_B)/d = 3 T_B
    BOOST_TEST(std::abs(behind.particles.scalar(Field::temperature)[scene.geometry.contacts[0].size() + k] - (2.0 * wall - T)) < 1e-12);
  }
}

/// A wall that moves throws its images back at twice its speed, along the normal alone.
BOOST_AUTO_TEST_CASE(gas_slips_along_a_wall_that_moves) {
  Mirrored<2> scene(false);
  Vector<2> const of_wall(0.7, 5.0);
  for (Wall<2>& wall : scene.geometry.walls) wall.velocity = [of_wall](Vector<2> const&, double) { return of_wall; };
  for (std::size_t w = 0; w < 2; ++w) {  // the walls across x
    WallParticles<2>& behind = scene.geometry.behind[w];
    fill_wall_particles(behind, scene.geometry.contacts[w], scene.geometry.walls, scene.particles, {Field::velocity}, 0.0);
    for (std::size_t k = 0; k < behind.placed.size(); ++k) {
      if (behind.placed[k].mirror_count > 1) continue;
      Vector<2> const v = scene.particles.vector(Field::velocity)[behind.placed[k].sources[0].first];
      Vector<2> const image = behind.particles.vector(Field::velocity)[scene.geometry.contacts[w].size() + k];
      BOOST_TEST(std::abs(image[0] - (1.4 - v[0])) < 1e-14);
      BOOST_TEST(image[1] == v[1]);
    }
  }
}

/// A gas that moves with all its walls is rubbed by none; one wall that comes on gives work of its own speed.
BOOST_AUTO_TEST_CASE_TEMPLATE(viscosity_knows_the_speed_of_walls, D, Dimensions) {
  constexpr int Dim = D::value;
  Mirrored<Dim> scene(false);
  Vector<Dim> const common = Vector<Dim>::Constant(0.3);
  for (std::size_t i = 0; i < scene.particles.size(); ++i) scene.particles.vector(Field::velocity).set(i, common);
  double speed = 0.3;
  for (Wall<Dim>& wall : scene.geometry.walls) wall.velocity = [&](Vector<Dim> const&, double) { return common; };
  Viscosity const viscosity = MonaghanViscosity{1.0, 2.0};
  auto const rubbed = [&] {
    ViscousRates<Dim> rates;
    PairSweep<Dim> sweep(scene.geometry.neighbours, scene.domain, 1);
    add_viscosity(viscosity, scene.particles, sweep, rates);
    sweep.run(scene.particles);
    add_viscous_walls(viscosity, scene.particles, scene.geometry, Closure::interpolated, 0.5, 0.0, 1, rates);
    return rates;
  };
  ViscousRates<Dim> const together = rubbed();
  BOOST_TEST(largest<Dim>(together.heating, scene.particles.size()) < 1e-13);
  speed = 1.1;  // of the lower wall of the first axis, into the gas
  scene.geometry.walls[0].velocity = [&](Vector<Dim> const&, double) {
    Vector<Dim> v = common;
    v[0] = speed;
    return v;
  };
  ViscousRates<Dim> const driven = rubbed();
  BOOST_TEST(driven.wall_force[0][0] > 0.0);
  if (Dim > 1) return;  // in corners its images' images are the other wall's
  for (std::size_t w = 1; w < scene.geometry.walls.size(); ++w) BOOST_TEST(driven.wall_force[w].norm() < 1e-13 * driven.wall_force[0].norm());
  // Images move at twice the wall's speed less the gas's: half of what they lose heats the gas, the rest pushes it.
  BOOST_TEST(std::abs(driven.wall_power[0] - driven.wall_force[0][0] * speed) < 1e-12 * driven.wall_power[0]);
}

BOOST_AUTO_TEST_CASE(walls_closer_than_the_support_are_refused) {
  Domain<2> const domain{.lower = Vector<2>::Zero(), .upper = {1.0, 0.2}};
  auto const walls = walls_of(domain);
  require_room_between_walls(walls, 0.2);
  auto oblique = walls;
  oblique[2].outward_normal = Vector<2>(0.6, -0.8);
  BOOST_CHECK_THROW(require_room_between_walls(oblique, 0.01), std::invalid_argument);
  try {
    require_room_between_walls(walls, 0.21);
    BOOST_TEST(false);
  } catch (std::invalid_argument const& error) {
    BOOST_TEST(std::string(error.what()) ==
               "walls 2 and 3 are 0.2 apart, less than the support of 0.21: what stands behind one would be seen through the other");
  }
}

BOOST_AUTO_TEST_SUITE_END()
