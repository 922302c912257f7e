// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/viscosity/viscosity.hpp"

#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_viscosity_monaghan)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

constexpr MonaghanViscosity both{.alpha = 0.8, .beta = 1.7};
constexpr BoundaryValueSet velocity_only{BoundaryValue::velocity};
constexpr BoundaryValueSet pressure_only{BoundaryValue::pressure};

template <int Dim>
void randomise_sound_speed(RandomScene<Dim>& scene, std::uint64_t seed) {
  Random random(seed);
  scene.particles.allocate(Field::sound_speed);
  for (double& c : scene.particles.scalar(Field::sound_speed)) c = random.uniform(0.3, 2.0);
}

/// A random scene with sound speeds, by default with two walls of prescribed velocity.
template <int Dim>
RandomScene<Dim> gas_scene(std::uint64_t seed, std::size_t count, BoundaryValueSet first = velocity_only,
                     BoundaryValueSet second = velocity_only) {
  RandomScene<Dim> scene = random_scene<Dim>(seed, count, first, second);
  randomise_sound_speed(scene, seed + 1000);
  return scene;
}

template <int Dim>
PairGeometry<Dim> gas_geometry(RandomScene<Dim> const& scene, bool with_walls = true) {
  PairGeometry<Dim> geometry = geometry_of(scene, with_walls);
  for (std::size_t w = 0; w < geometry.contacts.size(); ++w) {
    fill_boundary_values(geometry.contacts[w], geometry.walls[w], scene.particles, velocity_only | pressure_only,
                         scene.closure, scene.time);
  }
  return geometry;
}

template <int Dim>
void evaluate_viscosity(RandomScene<Dim> const& scene, PairGeometry<Dim> geometry,
                        MonaghanViscosity const& law, int threads, ViscousRates<Dim>& rates) {
  Viscosity const viscosity = law;
  PairSweep<Dim> sweep(geometry.neighbours, geometry.domain, threads);
  add_viscosity(viscosity, scene.particles, sweep, rates);
  sweep.run(scene.particles);
  add_viscous_walls(viscosity, scene.particles, geometry, scene.closure, 0.5, scene.time, threads, rates);
}

template <int Dim>
ViscousRates<Dim> viscous(RandomScene<Dim> const& scene, bool with_walls = true,
                          MonaghanViscosity const& viscosity = both, int threads = 1) {
  ViscousRates<Dim> rates;
  evaluate_viscosity(scene, gas_geometry(scene, with_walls), viscosity, threads, rates);
  return rates;
}

template <int Dim>
std::vector<Vector<Dim>> list(VectorField<Dim> const& field) {
  std::vector<Vector<Dim>> values;
  for (std::size_t i = 0; i < field.size(); ++i) values.push_back(field[i]);
  return values;
}

template <int Dim>
struct Expected {
  std::vector<Vector<Dim>> acceleration;
  std::vector<double> heating, largest_mu;
  std::vector<Vector<Dim>> wall_force;
  std::vector<double> wall_power;
};

inline double mu(double approach, double r2, double h) {
  return approach < 0.0 ? h * approach / (r2 + 0.01 * h * h) : 0.0;
}

inline double Pi(MonaghanViscosity const& viscosity, double mu, double c, double rho) {
  return (-viscosity.alpha * c * mu + viscosity.beta * mu * mu) / rho;
}

/// Monaghan's viscosity and the wall terms written down a second time. What the closures make of v_B and P_B is
/// tested with the walls; here it is taken from the contacts.
template <int Dim>
Expected<Dim> equation(RandomScene<Dim> const& scene, MonaghanViscosity const& viscosity, bool with_walls) {
  dense::State<Dim> const s(scene);
  PairGeometry<Dim> const geometry = gas_geometry(scene, with_walls);
  auto const contact = [&](std::size_t i, std::size_t w) {
    auto const& particle = geometry.contacts[w].particle;
    return static_cast<std::size_t>(std::ranges::lower_bound(particle, static_cast<std::uint32_t>(i)) - particle.begin());
  };
  auto const v_B = [&](std::size_t i, std::size_t w) -> Vector<Dim> { return geometry.contacts[w].velocity[contact(i, w)]; };
  // P_B less the gas's pressure at the foot point, the kernel's mean over the volumes there.
  auto const wave = [&](std::size_t i, std::size_t w) {
    Vector<Dim> const foot = geometry.contacts[w].foot[contact(i, w)];
    double sum = 0.0, weight = 0.0;
    for (std::size_t j = 0; j < s.particles(); ++j) {
      double const one = s.m(j) / s.rho(j) * dense::kernel<Dim>((s.x(j) - foot).norm(), s.h());
      sum += one * scene.particles.scalar(Field::pressure)[j];
      weight += one;
    }
    return std::max(0.0, geometry.contacts[w].pressure[contact(i, w)] - std::max(0.0, sum / weight));
  };
  auto const& c = scene.particles.scalar(Field::sound_speed);
  std::size_t const n = s.particles();
  Vector<Dim> const zero = Vector<Dim>::Zero();
  std::size_t const walls = with_walls ? s.walls() : 0;
  Expected<Dim> e{std::vector<Vector<Dim>>(n, zero), std::vector<double>(n, 0.0), std::vector<double>(n, 0.0),
                  std::vector<Vector<Dim>>(walls, zero), std::vector<double>(walls, 0.0)};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j || s.gradient(i, j).norm() == 0.0) continue;
      Vector<Dim> const r = s.x(i) - s.x(j);
      Vector<Dim> const v = s.v(i) - s.v(j);
      double const mu_ij = mu(v.dot(r), r.dot(r), s.h());
      double const P = Pi(viscosity, mu_ij, 0.5 * (c[i] + c[j]), 0.5 * (s.rho(i) + s.rho(j)));
      e.acceleration[i] -= s.m(j) * P * s.gradient(i, j);
      e.heating[i] += 0.5 * s.m(j) * P * v.dot(s.gradient(i, j));
      e.largest_mu[i] = std::max(e.largest_mu[i], -mu_ij);
    }
    for (std::size_t w = 0; w < walls; ++w) {
      if (!s.touches(i, w) || !scene.walls[w].velocity) continue;
      // From its image in the plane, also where the face ends before the foot point.
      Vector<Dim> const r = -2.0 * std::max(s.d(i, w), 0.05 * s.h()) * s.n(w);
      Vector<Dim> const v = s.v(i) - v_B(i, w);
      double const mu_iB = mu(2.0 * v.dot(s.n(w)) * r.dot(s.n(w)), r.dot(r), s.h());
      double const rho = 0.5 * (s.rho(i) + s.rho(i, w));
      double const half = 0.5 * Pi(viscosity, mu_iB, c[i], rho);
      double const in_pressure = scene.walls[w].prescribes(BoundaryValue::pressure)                  ? half
                                 : scene.closure == Closure::one_sided && scene.walls[w].gamma > 1.0 ? wave(i, w) / (rho * rho)
                                                                                                     : 0.0;
      double const P = (half + std::max(0.0, half - in_pressure)) * s.rho(i, w);
      Vector<Dim> const a = -P * s.S(i, w);
      e.acceleration[i] += a;
      e.heating[i] += P * v.dot(s.S(i, w));
      e.largest_mu[i] = std::max(e.largest_mu[i], -mu_iB);
      e.wall_force[w] += s.m(i) * a;
      e.wall_power[w] += s.m(i) * (P * v.dot(s.S(i, w)) + a.dot(s.v(i)));
    }
  }
  return e;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  constexpr int Dim = D::value;
  for (unsigned number = 0; number < 9; ++number) {
    for (Closure const closure : {Closure::interpolated, Closure::quotient, Closure::one_sided}) {
      bool const with_walls = number != 0;
      // Walls that prescribe pressure, velocity or both.
      RandomScene<Dim> scene = gas_scene<Dim>(50 + number, 50, subset(1 + number % 3), subset(1 + number / 3));
      scene.closure = closure;
      for (Wall<Dim>& wall : scene.walls) wall.gamma = 1.4;
      scene.face_weight = number % 3 == 0 ? FaceWeight::campbell : FaceWeight::exact;
      ViscousRates<Dim> const found = viscous(scene, with_walls);
      Expected<Dim> const expected = equation(scene, both, with_walls);
      BOOST_TEST(relative_difference(list(found.acceleration), expected.acceleration) < dense::round_off);
      BOOST_TEST(relative_difference(found.heating, expected.heating) < dense::round_off);
      BOOST_TEST(relative_difference(found.largest_mu, expected.largest_mu) < dense::round_off);
      BOOST_TEST_REQUIRE(found.wall_force.size() == expected.wall_force.size());
      BOOST_TEST_REQUIRE(found.wall_power.size() == expected.wall_power.size());
      if (!with_walls) continue;
      BOOST_TEST(relative_difference(found.wall_force, expected.wall_force) < dense::round_off);
      BOOST_TEST(relative_difference(found.wall_power, expected.wall_power) < dense::round_off);
    }
  }
}

/// Two particles at distance r on the x axis, of smoothing length 0.2, that close in at a speed.
RandomScene<1> two_particles(double r, double closing_speed) {
  RandomScene<1> scene{.particles = Particles<1>(2, 0.2),
                 .domain = {.lower = Vector<1>(-1.0), .upper = Vector<1>(1.0)}};
  scene.particles.allocate(all_fields);
  scene.particles.allocate(Field::sound_speed);
  scene.particles.positions().component(0) = {0.0, r};
  scene.particles.masses() = {1.0, 3.0};
  scene.particles.scalar(Field::density) = {1.0, 4.0};
  scene.particles.scalar(Field::sound_speed) = {0.6, 1.0};
  scene.particles.vector(Field::velocity).component(0) = {closing_speed + 0.7, 0.7};
  return scene;
}

BOOST_AUTO_TEST_CASE(two_particles_that_approach_push_each_other_apart_and_both_grow_hotter) {
  ViscousRates<1> const rates = viscous(two_particles(0.2, 1.5));
  double const mu_12 = -0.2 * 1.5 * 0.2 / (1.01 * 0.04);
  double const P = (-0.8 * 0.8 * mu_12 + 1.7 * mu_12 * mu_12) / 2.5;
  double const slope = 0.5 / 0.04;  // |grad W| at r = h
  BOOST_TEST(rates.acceleration[0][0] == -3.0 * P * slope, tolerance(1e-12));
  BOOST_TEST(rates.acceleration[1][0] == 1.0 * P * slope, tolerance(1e-12));
  BOOST_TEST(rates.heating[0] == 0.5 * 3.0 * P * 1.5 * slope, tolerance(1e-12));
  BOOST_TEST(rates.heating[1] == 0.5 * 1.0 * P * 1.5 * slope, tolerance(1e-12));
  BOOST_TEST(rates.largest_mu[0] == -mu_12, tolerance(1e-14));
  BOOST_TEST(rates.largest_mu[1] == -mu_12, tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(gas_that_expands_feels_nothing_at_all, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = gas_scene<Dim>(3, 60, {}, {});
  for (double const expansion : {1.0, 0.0, -1.0}) {
    for (std::size_t i = 0; i < 60; ++i)
      scene.particles.vector(Field::velocity).set(i, expansion * scene.particles.positions()[i]);
    // Walls that outrun the gas.
    for (Wall<Dim>& wall : scene.walls) {
      wall.velocity = [n = wall.outward_normal, expansion](Vector<Dim> const& x, double) -> Vector<Dim> {
        return expansion * (x + 2.0 * n);
      };
    }
    ViscousRates<Dim> const rates = viscous(scene);
    bool const acts = expansion < 0.0;
    BOOST_TEST((largest(list(rates.acceleration)) > 0.0) == acts);
    BOOST_TEST((largest(rates.heating) > 0.0) == acts);
    BOOST_TEST((largest(rates.largest_mu) > 0.0) == acts);
    BOOST_TEST((largest(rates.wall_force) > 0.0) == acts);
    BOOST_TEST((largest(rates.wall_power) > 0.0) == acts);
  }
}

BOOST_AUTO_TEST_CASE(particles_that_pass_each_other_at_right_angles_feel_nothing) {
  RandomScene<2> scene{.particles = Particles<2>(2, 0.2),
                 .domain = {.lower = Vector<2>::Zero(), .upper = Vector<2>::Ones()}};
  scene.particles.allocate(all_fields);
  scene.particles.allocate(Field::sound_speed);
  scene.particles.positions().set(1, {0.25, 0.0});
  scene.particles.masses() = {1.0, 1.0};
  scene.particles.scalar(Field::density) = {1.0, 1.0};
  scene.particles.vector(Field::velocity).set(0, {0.0, 3.0});
  ViscousRates<2> const rates = viscous(scene);
  BOOST_TEST(largest(list(rates.acceleration)) == 0.0);
  BOOST_TEST(largest(rates.heating) == 0.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(pairs_conserve_momentum_and_energy_to_round_off, D, Dimensions) {
  constexpr int Dim = D::value;
  for (bool const periodic : {false, true}) {
    RandomScene<Dim> scene = gas_scene<Dim>(4, Dim == 3 ? 200 : 60);
    scene.domain.periodic.fill(periodic);
    ViscousRates<Dim> const rates = viscous(scene, false);
    Vector<Dim> force = Vector<Dim>::Zero();
    double gross_force = 0.0, power = 0.0, gross_power = 0.0;
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
      double const m = scene.particles.masses()[i];
      double const kinetic = m * scene.particles.vector(Field::velocity)[i].dot(rates.acceleration[i]);
      force += m * rates.acceleration[i];
      gross_force += m * rates.acceleration[i].norm();
      power += kinetic + m * rates.heating[i];
      gross_power += std::abs(kinetic) + m * rates.heating[i];
    }
    BOOST_TEST(gross_force > 0.1);
    BOOST_TEST(force.norm() < 1e-14 * gross_force);
    BOOST_TEST(std::abs(power) < 1e-14 * gross_power);
  }
}

BOOST_AUTO_TEST_CASE(pairs_conserve_angular_momentum_to_round_off) {
  RandomScene<2> const scene = gas_scene<2>(5, 80);
  ViscousRates<2> const rates = viscous(scene, false);
  double torque = 0.0, gross = 0.0;
  for (std::size_t i = 0; i < 80; ++i) {
    Vector<2> const x = scene.particles.positions()[i];
    Vector<2> const F = scene.particles.masses()[i] * rates.acceleration[i];
    torque += x[0] * F[1] - x[1] * F[0];
    gross += x.norm() * F.norm();
  }
  BOOST_TEST(std::abs(torque) < 1e-14 * gross);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(nothing_grows_colder, D, Dimensions) {
  constexpr int Dim = D::value;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    for (Closure const closure : {Closure::interpolated, Closure::quotient, Closure::one_sided}) {
      RandomScene<Dim> scene = gas_scene<Dim>(seed, 60, velocity_only, pressure_only);
      scene.closure = closure;
      for (Wall<Dim>& wall : scene.walls) wall.gamma = 1.4;
      for (double const heating : viscous(scene).heating) BOOST_TEST(heating >= 0.0);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(does_not_depend_on_the_frame, D, Dimensions) {
  constexpr int Dim = D::value;
  Vector<Dim> const boost = Random(6).vector<Dim>(-10.0, 10.0);
  for (Closure const closure : {Closure::quotient, Closure::one_sided}) {
    // The second wall's velocity comes from the closure.
    RandomScene<Dim> scene = gas_scene<Dim>(6, 60, velocity_only, pressure_only);
    scene.closure = closure;
    for (Wall<Dim>& wall : scene.walls) wall.gamma = 1.4;
    RandomScene<Dim> moving = scene;
    for (std::size_t i = 0; i < 60; ++i) moving.particles.vector(Field::velocity).add(i, boost);
    moving.walls[0].velocity = [boost, old = scene.walls[0].velocity](Vector<Dim> const& x,
                                                                      double t) -> Vector<Dim> {
      return old(x, t) + boost;
    };
    ViscousRates<Dim> const one = viscous(scene);
    ViscousRates<Dim> const other = viscous(moving);
    BOOST_TEST(relative_difference(list(other.acceleration), list(one.acceleration)) < 1e-12);
    BOOST_TEST(relative_difference(other.heating, one.heating) < 1e-12);
    BOOST_TEST(relative_difference(other.wall_force, one.wall_force) < 1e-12);
  }
}

// Whoever moves the wall pays for all that the gas gains there; a wall at rest costs nothing.
BOOST_AUTO_TEST_CASE_TEMPLATE(rigid_wall_gives_its_force_times_its_velocity, D, Dimensions) {
  constexpr int Dim = D::value;
  for (bool const moves : {false, true}) {
    for (BoundaryValueSet const first : {velocity_only, velocity_only | pressure_only}) {
      for (Closure const closure : {Closure::interpolated, Closure::one_sided}) {
        RandomScene<Dim> scene = gas_scene<Dim>(7, 60, first, velocity_only);
        scene.closure = closure;
        for (Wall<Dim>& wall : scene.walls) wall.gamma = 1.4;
        Random random(2);
        for (std::size_t i = 0; i < 60; ++i) {  // so that some run into either wall
          Vector<Dim> const from_centre = scene.particles.positions()[i] - Vector<Dim>::Constant(0.5);
          scene.particles.vector(Field::velocity).add(i, 6.0 * from_centre);
        }
        std::vector<Vector<Dim>> v_B;
        for (Wall<Dim>& wall : scene.walls) {
          v_B.push_back(moves ? random.vector<Dim>(-1.0, 1.0) : Vector<Dim>::Zero());
          wall.velocity = [v = v_B.back()](Vector<Dim> const&, double) -> Vector<Dim> { return v; };
        }
        ViscousRates<Dim> const rates = viscous(scene);
        ViscousRates<Dim> const pairs = viscous(scene, false);
        double given = 0.0, gained = 0.0, gross = 0.0;
        for (std::size_t w = 0; w < 2; ++w) {
          BOOST_TEST(rates.wall_force[w].norm() > 0.0);
          double const speed = v_B[w].norm() + 1.0;
          BOOST_TEST(std::abs(rates.wall_power[w] - rates.wall_force[w].dot(v_B[w])) <
                     1e-13 * rates.wall_force[w].norm() * speed);
          BOOST_TEST(rates.wall_force[w].dot(scene.walls[w].outward_normal) < 0.0);  // it pushes inwards
          given += rates.wall_power[w];
        }
        for (std::size_t i = 0; i < 60; ++i) {
          Vector<Dim> const v = scene.particles.vector(Field::velocity)[i];
          double const now = rates.heating[i] + v.dot(rates.acceleration[i]);
          double const without = pairs.heating[i] + v.dot(pairs.acceleration[i]);
          gained += scene.particles.masses()[i] * (now - without);
          gross += scene.particles.masses()[i] * (std::abs(now) + std::abs(without));
        }
        BOOST_TEST(std::abs(gained - given) < 1e-12 * gross);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(wall_leaves_out_of_its_half_what_its_pressure_has_of_it, D, Dimensions) {
  constexpr int Dim = D::value;
  auto const force = [](BoundaryValueSet prescribed, Closure closure, double gamma, double speed = 2.0) {
    RandomScene<Dim> scene = gas_scene<Dim>(8, 60, prescribed, {});
    scene.walls.pop_back();  // it stands elsewhere for each, and would cut the first one's face
    scene.closure = closure;
    scene.walls[0].gamma = gamma;
    scene.walls[0].velocity = [n = scene.walls[0].outward_normal, speed](Vector<Dim> const&, double) -> Vector<Dim> {
      return -speed * n;
    };
    return viscous(scene).wall_force[0].norm();
  };
  double const whole = force(velocity_only, Closure::interpolated, 1.4);
  BOOST_TEST(whole > 0.0);
  BOOST_TEST(force(velocity_only, Closure::quotient, 1.4) == whole);
  BOOST_TEST(force(velocity_only, Closure::one_sided, 0.0) == whole);  // of no gas is there a wave
  double const beside_a_wave = force(velocity_only, Closure::one_sided, 1.4);
  BOOST_TEST((beside_a_wave > 0.501 * whole && beside_a_wave < 0.999 * whole), beside_a_wave / whole);
  for (Closure const closure : {Closure::interpolated, Closure::quotient, Closure::one_sided}) {
    BOOST_TEST(force(velocity_only | pressure_only, closure, 1.4) == 0.5 * whole, tolerance(1e-14));
  }
}

// Pairs push in full: unless the wall does, gas that is compressed alike everywhere is pushed onto it.
BOOST_AUTO_TEST_CASE_TEMPLATE(wall_term_is_the_sum_over_images_where_gas_is_compressed_alike_on_all_sides, D, Dimensions) {
  constexpr int Dim = D::value;
  constexpr double dx = 0.1, h = 0.24, rate = 0.7;
  int const along = Dim == 3 ? 11 : 15;  // wider than what the particle in the middle sees
  auto const gas = [&](int from) {
    std::vector<Vector<Dim>> places;
    std::array<int, Dim> at{};
    at[0] = from;
    int const sides = along / 2;
    for (int k = 1; k < Dim; ++k) at[static_cast<std::size_t>(k)] = -sides;
    while (true) {
      Vector<Dim> x;
      for (int k = 0; k < Dim; ++k) x[k] = (at[static_cast<std::size_t>(k)] + (k == 0 ? 0.5 : 0.0)) * dx;
      places.push_back(x);
      int k = Dim - 1;
      while (k > 0 && ++at[static_cast<std::size_t>(k)] > sides) at[static_cast<std::size_t>(k--)] = -sides;
      if (k == 0 && ++at[0] > 8) break;
    }
    RandomScene<Dim> scene{.particles = Particles<Dim>(places.size(), h),
                           .domain = {.lower = Vector<Dim>::Constant(-2.0), .upper = Vector<Dim>::Constant(2.0)}};
    scene.particles.allocate(all_fields);
    scene.particles.allocate(Field::sound_speed);
    for (std::size_t i = 0; i < places.size(); ++i) {
      scene.particles.positions().set(i, places[i]);
      scene.particles.vector(Field::velocity).set(i, -rate * places[i]);
      scene.particles.masses()[i] = std::pow(dx, Dim);
      scene.particles.scalar(Field::density)[i] = 1.0;
      scene.particles.scalar(Field::sound_speed)[i] = 1.0;
    }
    return scene;
  };
  RandomScene<Dim> halved = gas(0);
  halved.walls.push_back({.point = Vector<Dim>::Zero(), .outward_normal = -Vector<Dim>::Unit(0)});
  halved.walls[0].velocity = [](Vector<Dim> const&, double) -> Vector<Dim> { return Vector<Dim>::Zero(); };
  RandomScene<Dim> const whole = gas(-9);  // with its images
  ViscousRates<Dim> const beside_wall = viscous(halved), pairs = viscous(halved, false), images = viscous(whole);
  auto const index = [](RandomScene<Dim> const& scene, double depth) {
    std::size_t i = 0;
    while ((scene.particles.positions()[i] - depth * Vector<Dim>::Unit(0)).norm() > 1e-9) ++i;
    return i;
  };
  for (double const depth : {0.05, 0.15, 0.25}) {
    std::size_t const i = index(halved, depth);
    double const of_wall = beside_wall.acceleration[i][0] - pairs.acceleration[i][0];
    double const of_images = images.acceleration[index(whole, depth)][0] - pairs.acceleration[i][0];
    BOOST_TEST(of_images > 0.05);
    BOOST_TEST(of_wall == of_images, tolerance(0.1));
  }
}

// mu_ij fades where two meet, as the slope of their kernel does; a wall's face weight stays.
BOOST_AUTO_TEST_CASE(wall_does_not_let_go_of_a_particle_that_has_all_but_reached_it) {
  auto const push = [](double d) {
    RandomScene<1> scene = two_particles(0.9, 0.0);
    scene.particles.positions().component(0) = {1.0 - d, 0.1};
    scene.particles.vector(Field::velocity).component(0) = {1.3, 0.0};
    scene.walls.push_back({.point = Vector<1>(1.0), .outward_normal = Vector<1>(1.0)});
    scene.walls[0].velocity = [](Vector<1> const&, double) { return Vector<1>(0.3); };
    return -viscous(scene).acceleration[0][0];
  };
  double const nearest = push(0.01);  // 0.05 h
  // There mu_iB = 10 (v_i - v_B).n; W = 1/(1.5 h) but for 1%, rho_B = 2 m W.
  double const W = 1.0 / 0.3, rho_B = 2.0 * W;
  BOOST_TEST(nearest == (0.8 * 0.6 * 10.0 + 1.7 * 100.0) / (0.5 * (1.0 + rho_B)) * rho_B * W, tolerance(0.01));
  for (double const d : {1e-3, 1e-6, 1e-12}) BOOST_TEST(push(d) == nearest, tolerance(0.01));
}

// What a mirror image of the particle would do: cold gas must not run into a wall unopposed.
BOOST_AUTO_TEST_CASE(wall_pushes_back_a_particle_that_closes_in_and_lets_go_one_that_leaves) {
  for (double const side : {-1.0, 1.0}) {
    for (double const closing : {-1.0, 0.0, 1.0}) {
      RandomScene<1> scene = two_particles(0.9, 0.0);
      scene.particles.positions().component(0) = {0.8 * side, -0.1 * side};
      scene.particles.vector(Field::velocity).component(0) = {side * (closing + 0.3), 0.0};
      scene.walls.push_back({.point = Vector<1>(side), .outward_normal = Vector<1>(side)});
      scene.walls[0].velocity = [side](Vector<1> const&, double) { return Vector<1>(0.3 * side); };
      ViscousRates<1> const rates = viscous(scene);
      // d = h: W = A = 1/(6 h), rho_B = 2 m W.
      double const W = 1.0 / 1.2, rho_B = 2.0 * W;
      double const mu_B = closing > 0.0 ? 4.0 * closing / 4.01 : 0.0;  // its image is 2h away
      double const P = (0.8 * 0.6 * mu_B + 1.7 * mu_B * mu_B) / (0.5 * (1.0 + rho_B));
      BOOST_TEST(rates.acceleration[0][0] == -side * P * rho_B * W, tolerance(1e-12));
      BOOST_TEST(rates.heating[0] == P * rho_B * W * closing, tolerance(1e-12));
      BOOST_TEST(rates.largest_mu[0] == mu_B, tolerance(1e-12));
      BOOST_TEST(rates.acceleration[1][0] == 0.0);
      BOOST_TEST(rates.wall_force[0][0] == rates.acceleration[0][0], tolerance(1e-14));
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(alpha_is_linear_and_beta_quadratic_in_the_velocities, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = gas_scene<Dim>(9, 60, {}, {});
  RandomScene<Dim> faster = scene;
  for (int k = 0; k < Dim; ++k) {
    for (double& v : faster.particles.vector(Field::velocity).component(k)) v *= 2.0;
  }
  for (MonaghanViscosity const& viscosity :
       {MonaghanViscosity{.alpha = 1.0}, MonaghanViscosity{.beta = 1.0}}) {
    double const power = viscosity.alpha != 0.0 ? 2.0 : 4.0;
    ViscousRates<Dim> const one = viscous(scene, true, viscosity);
    ViscousRates<Dim> const other = viscous(faster, true, viscosity);
    BOOST_TEST(largest(one.heating) > 0.0);
    for (std::size_t i = 0; i < 60; ++i) {
      BOOST_TEST((other.acceleration[i] - power * one.acceleration[i]).norm() <=
                 1e-13 * one.acceleration[i].norm());
      BOOST_TEST(other.heating[i] == 2.0 * power * one.heating[i], tolerance(1e-13));
      BOOST_TEST(other.largest_mu[i] == 2.0 * one.largest_mu[i], tolerance(1e-14));
    }
  }
}

BOOST_AUTO_TEST_CASE(is_on_where_either_weight_is_and_does_nothing_where_none_is) {
  BOOST_TEST(!MonaghanViscosity{}.is_on());
  BOOST_TEST(MonaghanViscosity{.alpha = 1.0}.is_on());
  BOOST_TEST(MonaghanViscosity{.beta = 1.0}.is_on());
  ViscousRates<2> const rates = viscous(gas_scene<2>(10, 60), true, MonaghanViscosity{});
  BOOST_TEST(largest(list(rates.acceleration)) == 0.0);
  BOOST_TEST(largest(rates.heating) == 0.0);
  BOOST_TEST(largest(rates.wall_power) == 0.0);
  BOOST_TEST(largest(rates.largest_mu) > 0.0);
}

BOOST_AUTO_TEST_CASE(periodic_boundary_is_crossed_the_short_way) {
  RandomScene<1> scene = two_particles(0.2, 1.5);
  ViscousRates<1> const inside = viscous(scene);
  scene.domain.periodic = {true};
  scene.particles.positions().component(0) = {0.9, -0.9};
  ViscousRates<1> const across = viscous(scene);
  BOOST_TEST(across.acceleration[0][0] == inside.acceleration[0][0], tolerance(1e-12));
  BOOST_TEST(across.heating[1] == inside.heating[1], tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(own_smoothing_lengths_enter_as_their_mean_and_conserve_as_well, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = gas_scene<Dim>(11, 60);
  scene.particles.vary_smoothing_length();
  Random random(5);
  for (double& h : scene.particles.smoothing_lengths()) h *= random.uniform(0.6, 1.6);
  ViscousRates<Dim> rates;
  evaluate_viscosity(scene, geometry_of(scene, false), both, 1, rates);

  dense::State<Dim> const s(scene);
  auto const& c = scene.particles.scalar(Field::sound_speed);
  auto const& each = scene.particles.smoothing_lengths();
  std::vector<Vector<Dim>> expected(60, Vector<Dim>::Zero());
  Vector<Dim> force = Vector<Dim>::Zero();
  double power = 0.0, gross = 0.0;
  for (std::size_t i = 0; i < 60; ++i) {
    for (std::size_t j = 0; j < 60; ++j) {
      if (i == j) continue;
      Vector<Dim> const r = s.x(i) - s.x(j);
      double const mean = 0.5 * (each[i] + each[j]);
      double const mu_ij = mu((s.v(i) - s.v(j)).dot(r), r.dot(r), mean);
      double const P = Pi(both, mu_ij, 0.5 * (c[i] + c[j]), 0.5 * (s.rho(i) + s.rho(j)));
      expected[i] -= s.m(j) * P * dense::slope<Dim>(r.norm(), mean) * r / r.norm();
    }
    force += s.m(i) * rates.acceleration[i];
    power += s.m(i) * (rates.heating[i] + s.v(i).dot(rates.acceleration[i]));
    gross += s.m(i) * (rates.heating[i] + rates.acceleration[i].norm());
  }
  BOOST_TEST(relative_difference(list(rates.acceleration), expected) < dense::round_off);
  BOOST_TEST(force.norm() < 1e-14 * gross);
  BOOST_TEST(std::abs(power) < 1e-14 * gross);
}

BOOST_AUTO_TEST_CASE(evaluating_again_gives_the_same_result_whatever_stood_there_before) {
  RandomScene<2> const scene = gas_scene<2>(12, 60);
  ViscousRates<2> const fresh = viscous(scene);
  ViscousRates<2> rates = viscous(gas_scene<2>(13, 40));
  for (int n = 0; n < 2; ++n) {
    evaluate_viscosity(scene, gas_geometry(scene), both, 1, rates);
    BOOST_TEST(same_bits(rates.heating, fresh.heating));
    BOOST_TEST(same_bits(rates.largest_mu, fresh.largest_mu));
    BOOST_TEST(same_bits(rates.acceleration.component(1), fresh.acceleration.component(1)));
    BOOST_TEST(same_bits(rates.wall_power, fresh.wall_power));
  }
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_a_bit) {
  RandomScene<2> const scene = gas_scene<2>(14, 3000);
  ViscousRates<2> const one = viscous(scene);
  ViscousRates<2> const two = viscous(scene, true, both, 2);
  BOOST_TEST(same_bits(one.heating, two.heating));
  BOOST_TEST(same_bits(one.acceleration.component(0), two.acceleration.component(0)));
  BOOST_TEST(same_bits(one.largest_mu, two.largest_mu));
}

BOOST_AUTO_TEST_SUITE_END()
