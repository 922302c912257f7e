// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/walls/walls.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <stdexcept>
#include <string>

#include "cases/exact/riemann.hpp"
#include "formulations/kernels/kernel.hpp"
#include "formulations/walls/finite_face.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/kernels.hpp"

BOOST_AUTO_TEST_SUITE(formulations_walls_walls)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

template <int Dim>
WallContacts<Dim> contacts_of(RandomScene<Dim> const& scene, std::size_t wall = 0) {
  return geometry_of(scene).contacts[wall];
}

/// Both walls of a random scene with no corner: parallel, across the first axis.
template <int Dim>
RandomScene<Dim> random_slab(std::uint64_t seed, std::size_t count) {
  RandomScene<Dim> scene = random_scene<Dim>(seed, count, {}, {});
  scene.walls[0] = {.point = Vector<Dim>::Constant(-0.01), .outward_normal = -Vector<Dim>::Unit(0)};
  scene.walls[1] = {.point = Vector<Dim>::Constant(1.01), .outward_normal = Vector<Dim>::Unit(0)};
  return scene;
}

BOOST_AUTO_TEST_CASE(distance_is_positive_inside_and_the_foot_lies_on_the_plane) {
  Vector<2> const n(0.6, 0.8);
  Wall<2> const wall{.point = {1.0, 1.0}, .outward_normal = n};
  Vector<2> const x = Vector<2>(1.0, 1.0) - 0.3 * n + 0.7 * Vector<2>(-0.8, 0.6);
  BOOST_TEST(wall.distance(x) == 0.3, tolerance(1e-14));
  BOOST_TEST((wall.foot(x) - (Vector<2>(1.0, 1.0) + 0.7 * Vector<2>(-0.8, 0.6))).norm() < 1e-15);
  BOOST_TEST(wall.distance(wall.point + 0.2 * n) == -0.2, tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(wall_knows_what_it_prescribes) {
  Wall<1> wall{.point = Vector<1>(0.0), .outward_normal = Vector<1>(-1.0)};
  constexpr BoundaryValue values[] = {BoundaryValue::pressure, BoundaryValue::velocity,
                                      BoundaryValue::temperature, BoundaryValue::conductivity,
                                      BoundaryValue::flux};
  for (BoundaryValue const value : values) BOOST_TEST(!wall.prescribes(value));
  wall.velocity = [](Vector<1> const&, double) { return Vector<1>(0.0); };
  wall.conductivity = [](Vector<1> const&, double) { return 1.0; };
  for (BoundaryValue const value : values) {
    BOOST_TEST(wall.prescribes(value) ==
               (value == BoundaryValue::velocity || value == BoundaryValue::conductivity));
  }
}

// docs/theory/face-weights.md. The report multiplies the kernel's value at the foot point by the whole area.
BOOST_AUTO_TEST_CASE(campbells_face_weight_at_the_wall_is_too_large_by_8_3_in_2d_and_40_7_in_3d) {
  double const h = 0.3;
  auto const ratio = [h](auto dim) {
    constexpr int Dim = decltype(dim)::value;
    return face_weight<Dim>(0.0, h, FaceWeight::campbell, default_kernel(Dim)) /
           face_weight<Dim>(0.0, h, FaceWeight::exact, default_kernel(Dim));
  };
  BOOST_TEST(ratio(std::integral_constant<int, 1>{}) == 1.0);
  BOOST_TEST(ratio(std::integral_constant<int, 2>{}) == 8.0 / 3.0, tolerance(1e-14));
  BOOST_TEST(ratio(std::integral_constant<int, 3>{}) == 40.0 / 7.0, tolerance(1e-14));
}

// The numbers per h/dx that docs/findings/two-and-three-dimensions.md prints, for the first particle of a lattice.
BOOST_AUTO_TEST_CASE(campbells_face_weight_at_the_first_particle_is_too_large_by_what_the_findings_say) {
  struct Printed {
    double smoothing_ratio, in_2d, in_3d;
  };
  for (Printed const& p : {Printed{1.0, 2.616, 5.53}, Printed{1.2, 2.626, 5.57}, Printed{1.5, 2.636, 5.61},
                           Printed{2.0, 2.646, 5.65}}) {
    auto const ratio = [&](auto dim) {
      constexpr int Dim = decltype(dim)::value;
      return face_weight<Dim>(0.5, p.smoothing_ratio, FaceWeight::campbell, default_kernel(Dim)) /
             face_weight<Dim>(0.5, p.smoothing_ratio, FaceWeight::exact, default_kernel(Dim));
    };
    BOOST_TEST(std::abs(ratio(std::integral_constant<int, 2>{}) - p.in_2d) < 0.0005);
    BOOST_TEST(std::abs(ratio(std::integral_constant<int, 3>{}) - p.in_3d) < 0.005);
  }
}

BOOST_AUTO_TEST_CASE(
    campbells_face_weight_at_the_edge_of_the_support_is_too_large_by_35_16_in_2d_and_4_in_3d) {
  auto const ratio = [](auto dim) {
    constexpr int Dim = decltype(dim)::value;
    return face_weight<Dim>(1.999, 1.0, FaceWeight::campbell, default_kernel(Dim)) /
           face_weight<Dim>(1.999, 1.0, FaceWeight::exact, default_kernel(Dim));
  };
  BOOST_TEST(ratio(std::integral_constant<int, 2>{}) == 35.0 / 16.0, tolerance(1e-2));
  BOOST_TEST(ratio(std::integral_constant<int, 3>{}) == 4.0, tolerance(1e-2));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(campbells_face_weight_is_equations_69_to_71, D, Dimensions) {
  constexpr int Dim = D::value;
  double const h = 0.3;
  for (double const q : {0.0, 0.4, 1.0, 1.7, 1.999, 2.0, 2.5}) {
    double const d = q * h;
    double const constant[] = {1.0, 2.0, std::numbers::pi};
    double const area = q < 2.0 ? constant[Dim - 1] * std::pow(4.0 * h * h - d * d, 0.5 * (Dim - 1)) : 0.0;
    BOOST_TEST(
        face_weight<Dim>(d, h, FaceWeight::campbell, default_kernel(Dim)) == dense::kernel<Dim>(d, h) * area,
        tolerance(1e-11));
    BOOST_TEST(face_weight<Dim>(d, h, FaceWeight::exact, default_kernel(Dim)) ==
               default_kernel(Dim).plane_integral(d, h));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(contacts_are_the_particles_within_reach_with_their_geometry, D, Dimensions) {
  constexpr int Dim = D::value;
  for (FaceWeight const rule : {FaceWeight::campbell, FaceWeight::exact, FaceWeight::balanced}) {
    for (bool const corner : {false, true}) {
      RandomScene<Dim> scene = corner ? random_scene<Dim>(4, 60) : random_slab<Dim>(4, 60);
      scene.face_weight = rule;
      dense::State<Dim> const s(scene);
      for (std::size_t w = 0; w < 2; ++w) {
        WallContacts<Dim> const contacts = contacts_of(scene, w);
        std::size_t c = 0;
        for (std::size_t i = 0; i < 60; ++i) {
          if (!s.touches(i, w)) continue;
          BOOST_TEST_REQUIRE(c < contacts.size());
          BOOST_TEST(contacts.particle[c] == i);
          BOOST_TEST(contacts.distance[c] == s.d(i, w), tolerance(1e-13));
          BOOST_TEST(std::abs(contacts.face_weight[c] - s.A(i, w)) < 1e-12 / s.h());
          BOOST_TEST((contacts.foot[c] - s.foot(i, w)).norm() < 1e-14);
          BOOST_TEST(contacts.foot_density[c] == s.rho(i, w), tolerance(1e-9));
          ++c;
        }
        BOOST_TEST(contacts.size() == c);
        BOOST_TEST((contacts.outward_normal - s.n(w)).norm() == 0.0);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(balanced_weight_leaves_a_uniform_state_without_force_along_the_normal, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  for (bool const disorder : {false, true}) {
    RandomScene<Dim> scene = lattice_scene<Dim>(Dim == 3 ? 8 : 14, 0.1, 1.2);
    if (disorder) {
      Random random(3);
      auto& positions = scene.particles.positions();
      for (std::size_t i = 0; i < positions.size(); ++i) positions.add(i, random.vector<Dim>(-0.02, 0.02));
      for (double& rho : scene.particles.scalar(Field::density)) rho = random.uniform(0.8, 1.2);
    }
    scene.walls.push_back({.point = scene.domain.upper, .outward_normal = Vector<Dim>::Unit(Dim - 1)});
    scene.face_weight = FaceWeight::balanced;
    dense::State<Dim> const s(scene);
    WallContacts<Dim> const contacts = contacts_of(scene);
    BOOST_TEST_REQUIRE(contacts.size() > 0u);
    double worst = 0.0;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      std::size_t const i = contacts.particle[c];
      Vector<Dim> residual = contacts.face_weight[c] * contacts.outward_normal;
      for (std::size_t j = 0; j < s.particles(); ++j) residual += s.m(j) / s.rho(j) * s.gradient(i, j);
      worst = std::max(worst, std::abs(residual[Dim - 1]));
    }
    BOOST_TEST(worst < 1e-13 / s.h());
  }
}

BOOST_AUTO_TEST_CASE(balanced_weight_falls_back_to_exact_where_two_walls_are_near) {
  RandomScene<2> scene = lattice_scene<2>(14, 0.1, 1.2);
  scene.walls.push_back({.point = scene.domain.upper, .outward_normal = {1.0, 0.0}});
  scene.walls.push_back({.point = scene.domain.upper, .outward_normal = {0.0, 1.0}});
  scene.face_weight = FaceWeight::balanced;
  WallContacts<2> const contacts = contacts_of(scene);
  double const reach = 2.0 * scene.particles.smoothing_length();
  std::size_t corner = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    Vector<2> const x = scene.particles.positions()[contacts.particle[c]];
    double const exact = face_weight(x, scene.walls, 0, 0.5 * reach, FaceWeight::exact, default_kernel(2));
    bool const near_both = scene.walls[1].distance(contacts.foot[c]) < reach;
    corner += near_both ? 1 : 0;
    BOOST_TEST((contacts.face_weight[c] == exact) == near_both);
  }
  BOOST_TEST(corner > 0u);
}

/// A resolved lattice of unit density in the corner of as many right angles as there are dimensions.
template <int Dim>
RandomScene<Dim> lattice_corner(double smoothing_ratio) {
  RandomScene<Dim> scene = lattice_scene<Dim>(Dim == 1 ? 60 : (Dim == 2 ? 40 : 16), 0.1, smoothing_ratio);
  for (int k = 0; k < Dim; ++k)
    scene.walls.push_back({.point = scene.domain.upper, .outward_normal = Vector<Dim>::Unit(k)});
  return scene;
}

// The report's infinite planes push it out of the corner.
BOOST_AUTO_TEST_CASE_TEMPLATE(resolved_uniform_state_feels_no_force_in_a_corner, D, Dimensions) {
  constexpr int Dim = D::value;
  double const ratio = Dim == 3 ? 2.5 : 5.0;
  RandomScene<Dim> const scene = lattice_corner<Dim>(ratio);
  dense::State<Dim> const s(scene);
  std::uint32_t const i = static_cast<std::uint32_t>(s.particles() - 1);  // in the corner
  Vector<Dim> residual = Vector<Dim>::Zero(), infinite = Vector<Dim>::Zero();
  for (std::size_t j = 0; j < s.particles(); ++j) residual += s.m(j) * s.gradient(i, j);
  double const pull = residual.norm();
  infinite = residual;
  for (std::size_t w = 0; w < scene.walls.size(); ++w) {
    WallContacts<Dim> const contacts = contacts_of(scene, w);
    BOOST_TEST_REQUIRE(contacts.particle.back() == i);
    residual += contacts.face_weight.back() * contacts.outward_normal;
    infinite += face_weight<Dim>(contacts.distance.back(), s.h(), FaceWeight::exact, default_kernel(Dim)) *
                contacts.outward_normal;
  }
  BOOST_TEST_MESSAGE(Dim << "D: " << residual.norm() / pull << ", infinite planes "
                         << infinite.norm() / pull);
  BOOST_TEST(residual.norm() < 0.03 * pull);
  if (Dim > 1) BOOST_TEST(infinite.norm() > 0.5 * pull);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(resolved_uniform_density_is_interpolated_into_the_corner_as_it_is, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = lattice_corner<Dim>(Dim == 3 ? 2.5 : 5.0);
  double worst = 0.0;
  for (std::size_t w = 0; w < scene.walls.size(); ++w) {
    WallContacts<Dim> const contacts = contacts_of(scene, w);
    Vector<Dim> const far = Vector<Dim>::Constant(-0.2);  // lattice's other ends have no walls
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if ((contacts.foot[c] - far).minCoeff() > 0.0)
        worst = std::max(worst, std::abs(contacts.foot_density[c] - 1.0));
    }
    BOOST_TEST((contacts.foot[contacts.size() - 1] - scene.walls[w].foot(contacts.foot[contacts.size() - 1]))
                   .norm() < 1e-14);
  }
  BOOST_TEST_MESSAGE(Dim << "D: density off by " << worst);
  BOOST_TEST(worst < (Dim == 3 ? 0.03 : 0.01));
}

using MoreDimensions = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

BOOST_AUTO_TEST_CASE_TEMPLATE(foot_point_beyond_an_obtuse_corner_is_on_the_edge_and_the_distance_the_plane_s,
                              D, MoreDimensions) {
  constexpr int Dim = D::value;
  // 120 degrees: the plane x_0 = 0, and one that leans away from it at the origin.
  RandomScene<Dim> scene{
      .particles = Particles<Dim>(2, 0.5),
      .domain = {.lower = Vector<Dim>::Constant(-3.0), .upper = Vector<Dim>::Constant(3.0)}};
  scene.particles.allocate(all_fields);
  Vector<Dim> lean = Vector<Dim>::Zero();
  lean[0] = -0.5;
  lean[1] = -0.5 * std::sqrt(3.0);
  scene.walls.push_back({.point = Vector<Dim>::Zero(), .outward_normal = -Vector<Dim>::Unit(0)});
  scene.walls.push_back({.point = Vector<Dim>::Zero(), .outward_normal = lean});
  Vector<Dim> near = Vector<Dim>::Zero(), out_of_reach = Vector<Dim>::Zero();
  near[0] = 0.6;
  near[1] = -0.3;
  out_of_reach[0] = 0.95;
  out_of_reach[1] = -0.5;
  scene.particles.positions().set(0, near);
  scene.particles.positions().set(1, out_of_reach);
  scene.particles.masses() = {1.0, 1.0};
  WallContacts<Dim> const contacts = contacts_of(scene);
  BOOST_TEST_REQUIRE(contacts.size() == 1u);
  BOOST_TEST(contacts.particle[0] == 0u);
  BOOST_TEST(contacts.distance[0] == 0.6, tolerance(1e-14));
  BOOST_TEST(contacts.foot[0].norm() < 1e-14);
  BOOST_TEST(contacts.face_weight[0] > 0.0);
  // A third of the kernel at the edge lies in the fluid.
  double const expected = 3.0 * dense::kernel<Dim>(near.norm(), 0.5);
  BOOST_TEST(contacts.foot_density[0] == expected, tolerance(1e-10));
}

// equations.md: the balanced weight "can be negative on disorder".
BOOST_AUTO_TEST_CASE(balanced_weight_can_be_negative_on_disorder) {
  double least = 1.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomScene<2> scene = random_slab<2>(seed, 60);
    scene.face_weight = FaceWeight::balanced;
    for (double const A : contacts_of(scene).face_weight) least = std::min(least, A);
  }
  BOOST_TEST(least < 0.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(particle_on_or_outside_a_wall_is_refused_by_name, D, Dimensions) {
  constexpr int Dim = D::value;
  for (double const outside : {0.0, 0.3}) {
    RandomScene<Dim> scene = random_slab<Dim>(1, 20);
    Vector<Dim> x = scene.particles.positions()[13];
    x[0] = 1.01 + outside;
    scene.particles.positions().set(13, x);
    auto const names_it = [](std::invalid_argument const& problem) {
      return std::string(problem.what()).find("particle 13 ") != std::string::npos;
    };
    BOOST_CHECK_EXCEPTION(contacts_of(scene, 1), std::invalid_argument, names_it);
  }
}

BOOST_AUTO_TEST_CASE(particle_exactly_at_reach_is_no_contact) {
  RandomScene<1> scene{.particles = Particles<1>(2, 0.25),
                       .domain = {.lower = Vector<1>(0.0), .upper = Vector<1>(1.0)}};
  scene.particles.allocate(all_fields);
  scene.particles.positions().component(0) = {0.5, 0.25};
  scene.particles.masses() = {1.0, 1.0};
  scene.walls.push_back({.point = Vector<1>(0.0), .outward_normal = Vector<1>(-1.0)});
  WallContacts<1> const contacts = contacts_of(scene);
  BOOST_TEST_REQUIRE(contacts.size() == 1u);
  BOOST_TEST(contacts.particle[0] == 1u);
}

// Eqs. 13, 73: twice the sum over half the kernel gives the density itself.
BOOST_AUTO_TEST_CASE_TEMPLATE(foot_density_of_a_uniform_lattice_is_about_its_density_and_exactly_a_dense_sum,
                              D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = lattice_scene<Dim>(Dim == 3 ? 12 : 20, 0.1, 1.3);
  scene.walls.push_back({.point = scene.domain.upper, .outward_normal = Vector<Dim>::Unit(0)});
  dense::State<Dim> const s(scene);
  WallContacts<Dim> const contacts = contacts_of(scene);
  CellGrid<Dim> const grid(scene.particles.positions(), scene.domain, 2.0 * s.h());
  double closest = 1.0;
  for (std::size_t c = 0; c < contacts.size(); c += 7) {
    double const expected = s.rho(contacts.particle[c], 0);
    BOOST_TEST(contacts.foot_density[c] == expected, tolerance(1e-12));
    BOOST_TEST(foot_density(grid, contacts.foot[c], scene.walls, s.h(), scene.particles.masses(),
                            default_kernel(Dim)) == expected,
               tolerance(1e-12));
    closest = std::min(closest, std::abs(expected - 1.0));
  }
  BOOST_TEST(closest < 0.02);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(values_that_the_wall_does_not_prescribe_are_interpolated, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = random_slab<Dim>(2, 60);
  Random random(8);
  for (std::size_t i = 0; i < 60; ++i)
    scene.particles.vector(Field::flux).set(i, random.vector<Dim>(-1.0, 1.0));
  auto& flux = scene.particles.vector(Field::flux);
  std::vector<Vector<Dim>> fluxes;
  for (std::size_t i = 0; i < 60; ++i) fluxes.push_back(flux[i]);
  WallContacts<Dim> contacts = contacts_of(scene);
  fill_boundary_values(contacts, scene.walls[0], scene.particles,
                       {BoundaryValue::pressure, BoundaryValue::velocity, BoundaryValue::temperature,
                        BoundaryValue::conductivity, BoundaryValue::flux},
                       Closure::interpolated, 0.0);
  dense::State<Dim> const s(scene);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    std::size_t const i = contacts.particle[c];
    BOOST_TEST(contacts.pressure[c] == s.P(i, 0), tolerance(1e-9));
    BOOST_TEST((contacts.velocity[c] - s.v(i, 0)).norm() < 1e-12);
    BOOST_TEST(contacts.temperature[c] == s.T(i, 0), tolerance(1e-9));
    BOOST_TEST(contacts.conductivity[c] == s.K(i, 0), tolerance(1e-9));
    BOOST_TEST((contacts.flux[c] - s.F(i, 0, fluxes)).norm() < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(interpolation_of_a_constant_is_twice_the_volume_weighted_kernel_sum) {
  RandomScene<1> scene = lattice_scene<1>(40, 0.05, 1.0);
  scene.particles.scalar(Field::pressure).assign(40, 3.0);
  scene.walls.push_back({.point = Vector<1>(1.0), .outward_normal = Vector<1>(1.0)});
  WallContacts<1> contacts = contacts_of(scene);
  fill_boundary_values(contacts, scene.walls[0], scene.particles, {BoundaryValue::pressure},
                       Closure::interpolated, 0.0);
  // Particles 0.5 and 1.5 h from the wall: 2 (W(0.5) + W(1.5)) h = 2 (23/48 + 1/48) = 1.
  for (double const P : contacts.pressure) BOOST_TEST(P == 3.0, tolerance(1e-12));
  BOOST_TEST(contacts.temperature.empty());  // was not asked for
  BOOST_TEST(contacts.velocity.size() == 0u);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(prescribed_values_are_taken_at_the_foot_point_and_at_the_time, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = random_slab<Dim>(3, 60);
  Wall<Dim>& wall = scene.walls[1];
  wall.pressure = [](Vector<Dim> const& x, double t) { return 1.0 + x.sum() + 10.0 * t; };
  wall.temperature = [](Vector<Dim> const& x, double t) { return 2.0 + x.sum() - 3.0 * t; };
  wall.conductivity = [](Vector<Dim> const& x, double t) { return 3.0 + x.sum() + t; };
  wall.velocity = [](Vector<Dim> const& x, double t) -> Vector<Dim> { return t * x; };
  wall.flux = [](Vector<Dim> const& x, double t) -> Vector<Dim> { return (1.0 - t) * x; };
  WallContacts<Dim> contacts = contacts_of(scene, 1);
  for (Closure const closure : {Closure::interpolated, Closure::one_sided}) {
    for (double const t : {0.0, 2.5}) {
      fill_boundary_values(contacts, wall, scene.particles,
                           {BoundaryValue::pressure, BoundaryValue::velocity, BoundaryValue::temperature,
                            BoundaryValue::conductivity, BoundaryValue::flux},
                           closure, t);
      for (std::size_t c = 0; c < contacts.size(); ++c) {
        Vector<Dim> const x = contacts.foot[c];
        BOOST_TEST(contacts.pressure[c] == 1.0 + x.sum() + 10.0 * t);
        BOOST_TEST(contacts.temperature[c] == 2.0 + x.sum() - 3.0 * t);
        BOOST_TEST(contacts.conductivity[c] == 3.0 + x.sum() + t);
        BOOST_TEST((contacts.velocity[c] - t * x).norm() == 0.0);
        BOOST_TEST((contacts.flux[c] - (1.0 - t) * x).norm() == 0.0);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(one_sided_closure_is_fouriers_law_between_particle_and_foot, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = random_slab<Dim>(5, 60);
  Wall<Dim>& hot = scene.walls[0];
  hot.temperature = [](Vector<Dim> const&, double) { return 2.0; };
  hot.conductivity = [](Vector<Dim> const&, double) { return 0.7; };
  Wall<Dim>& heated = scene.walls[1];
  heated.flux = [](Vector<Dim> const&, double) -> Vector<Dim> { return Vector<Dim>::Constant(0.3); };
  auto& K = scene.particles.scalar(Field::conductivity);
  auto const& T = scene.particles.scalar(Field::temperature);
  WallContacts<Dim> contacts = contacts_of(scene, 0);
  constexpr BoundaryValueSet both{BoundaryValue::temperature, BoundaryValue::flux};
  fill_boundary_values(contacts, hot, scene.particles, both, Closure::one_sided, 0.0);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    Vector<Dim> expected = Vector<Dim>::Zero();  // hotter than the gas: into the fluid, along +x
    expected[0] = 0.7 * (2.0 - T[contacts.particle[c]]) / contacts.distance[c];
    BOOST_TEST((contacts.flux[c] - expected).norm() <= 1e-14 * expected.norm());
  }
  contacts = contacts_of(scene, 1);
  BOOST_TEST(contacts.prescribes_flux_only);
  K[contacts.particle[0]] = 0.0;  // nothing conducts: the wall is at the particle's own temperature
  fill_boundary_values(contacts, heated, scene.particles, both, Closure::one_sided, 0.0);
  BOOST_TEST(contacts.temperature[0] == T[contacts.particle[0]]);
  for (std::size_t c = 1; c < contacts.size(); ++c) {
    std::size_t const i = contacts.particle[c];
    BOOST_TEST(contacts.temperature[c] == T[i] - 0.3 * contacts.distance[c] / K[i], tolerance(1e-13));
  }
}

BOOST_AUTO_TEST_CASE(wall_that_gives_temperature_and_flux_keeps_both_under_either_closure) {
  RandomScene<1> scene = random_slab<1>(5, 20);
  Wall<1>& wall = scene.walls[0];
  wall.temperature = [](Vector<1> const&, double) { return 2.0; };
  wall.conductivity = [](Vector<1> const&, double) { return 0.7; };
  wall.flux = [](Vector<1> const&, double) { return Vector<1>(0.3); };
  WallContacts<1> contacts = contacts_of(scene);
  BOOST_TEST(!contacts.prescribes_flux_only);
  fill_boundary_values(contacts, wall, scene.particles, {BoundaryValue::temperature, BoundaryValue::flux},
                       Closure::one_sided, 0.0);
  BOOST_TEST(contacts.temperature[0] == 2.0);
  BOOST_TEST(contacts.flux[0][0] == 0.3);
}

BOOST_AUTO_TEST_CASE(wall_that_prescribes_nothing_is_interpolated_under_either_closure) {
  RandomScene<1> const scene = random_slab<1>(6, 20);
  constexpr BoundaryValueSet both{BoundaryValue::temperature, BoundaryValue::flux};
  WallContacts<1> one = contacts_of(scene);
  WallContacts<1> other = contacts_of(scene);
  fill_boundary_values(one, scene.walls[0], scene.particles, both, Closure::interpolated, 0.0);
  fill_boundary_values(other, scene.walls[0], scene.particles, both, Closure::one_sided, 0.0);
  BOOST_TEST(same_bits(one.temperature, other.temperature));
  BOOST_TEST(same_bits(one.flux.component(0), other.flux.component(0)));
}

BOOST_AUTO_TEST_CASE(contacts_count_the_memory_they_hold) {
  RandomScene<2> const scene = random_slab<2>(6, 60);
  WallContacts<2> contacts = contacts_of(scene);
  std::size_t const before = contacts.bytes();
  BOOST_TEST(before >= contacts.size() * (5 * sizeof(double) + sizeof(std::uint32_t)));
  fill_boundary_values(contacts, scene.walls[0], scene.particles, {BoundaryValue::velocity},
                       Closure::interpolated, 0.0);
  BOOST_TEST(contacts.bytes() == before + 2 * contacts.size() * sizeof(double));
}

constexpr BoundaryValueSet every_value{BoundaryValue::pressure, BoundaryValue::velocity,
                                       BoundaryValue::temperature, BoundaryValue::conductivity,
                                       BoundaryValue::flux};

/// Gives particles the density sum_j m_j W_ij.
template <int Dim>
void set_summation_density(RandomScene<Dim>& scene) {
  dense::State<Dim> const s(scene);
  std::vector<double> density(s.particles(), 0.0);
  for (std::size_t i = 0; i < s.particles(); ++i) {
    for (std::size_t j = 0; j < s.particles(); ++j) {
      density[i] += s.m(j) * dense::kernel<Dim>((s.x(i) - s.x(j)).norm(), s.h());
    }
  }
  scene.particles.scalar(Field::density) = density;
}

/// sum_j (m_j/rho_j) f_j W(r_j - r_B) / sum_j (m_j/rho_j) W(r_j - r_B)
template <int Dim, class Function>
auto quotient(dense::State<Dim> const& s, Vector<Dim> const& foot, Function const& f) {
  auto above = f(0);
  above *= 0.0;
  double below = 0.0;
  for (std::size_t j = 0; j < s.particles(); ++j) {
    double const weight = s.m(j) / s.rho(j) * dense::kernel<Dim>((s.x(j) - foot).norm(), s.h());
    above += weight * f(j);
    below += weight;
  }
  above /= below;
  return above;
}

/// The gas at a foot point, by a dense sum.
template <int Dim>
struct DenseGas {
  double rho, P;
  Vector<Dim> v;
  DenseGas(dense::State<Dim> const& s, Vector<Dim> const& foot)
      : rho(quotient(s, foot, [&](std::size_t j) { return s.rho(j); })),
        P(quotient(s, foot, [&](std::size_t j) { return s.P(j); })),
        v(quotient(s, foot, [&](std::size_t j) { return s.v(j); })) {}
};

BOOST_AUTO_TEST_CASE_TEMPLATE(quotient_returns_a_constant_on_any_disorder_and_with_any_density, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    for (bool const summation : {false, true}) {
      RandomScene<Dim> scene =
          seed % 2 == 0 ? random_slab<Dim>(seed, 60) : random_scene<Dim>(seed, 60, {}, {});
      if (summation) set_summation_density(scene);
      scene.particles.scalar(Field::pressure).assign(60, 3.0);
      scene.particles.scalar(Field::temperature).assign(60, -7.0);
      for (std::size_t i = 0; i < 60; ++i)
        scene.particles.vector(Field::velocity).set(i, Vector<Dim>::Constant(0.3));
      for (std::size_t w = 0; w < 2; ++w) {
        WallContacts<Dim> contacts = contacts_of(scene, w);
        fill_boundary_values(contacts, scene.walls[w], scene.particles, every_value, Closure::quotient, 0.0);
        BOOST_TEST_REQUIRE(contacts.size() > 0u);
        for (std::size_t c = 0; c < contacts.size(); ++c) {
          BOOST_TEST(contacts.pressure[c] == 3.0, tolerance(1e-13));
          BOOST_TEST(contacts.temperature[c] == -7.0, tolerance(1e-13));
          BOOST_TEST((contacts.velocity[c] - Vector<Dim>::Constant(0.3)).norm() < 1e-14);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(quotient_is_a_dense_quotient_for_every_value, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = random_scene<Dim>(12, 60, {}, {});
  Random random(8);
  for (std::size_t i = 0; i < 60; ++i)
    scene.particles.vector(Field::flux).set(i, random.vector<Dim>(-1.0, 1.0));
  auto const& flux = scene.particles.vector(Field::flux);
  dense::State<Dim> const s(scene);
  for (std::size_t w = 0; w < 2; ++w) {
    WallContacts<Dim> contacts = contacts_of(scene, w);
    fill_boundary_values(contacts, scene.walls[w], scene.particles, every_value, Closure::quotient, 0.0);
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      Vector<Dim> const foot = s.foot(contacts.particle[c], w);
      auto const at_foot = [&](auto const& f) { return quotient(s, foot, f); };
      BOOST_TEST(contacts.pressure[c] == at_foot([&](std::size_t j) { return s.P(j); }), tolerance(1e-9));
      BOOST_TEST(contacts.temperature[c] == at_foot([&](std::size_t j) { return s.T(j); }), tolerance(1e-9));
      BOOST_TEST(contacts.conductivity[c] == at_foot([&](std::size_t j) { return s.K(j); }), tolerance(1e-9));
      BOOST_TEST((contacts.velocity[c] - at_foot([&](std::size_t j) { return s.v(j); })).norm() < 1e-9);
      BOOST_TEST((contacts.flux[c] - at_foot([&](std::size_t j) { return flux[j]; })).norm() < 1e-9);
    }
  }
}

// equations.md: the volumes m/rho swell at a wall where the density is a sum, so that Eq. 74 returns 1.25
// times a constant at h/dx = 1.2 and 2 ln 2 times it as h/dx grows.
BOOST_AUTO_TEST_CASE(quotient_mends_what_interpolation_makes_of_a_constant_with_summation_density) {
  auto const at_first_particle = [](double smoothing_ratio, Closure closure) {
    RandomScene<1> scene = lattice_scene<1>(400, 0.01, smoothing_ratio);
    scene.walls.push_back({.point = scene.domain.upper, .outward_normal = Vector<1>(1.0)});
    set_summation_density(scene);
    scene.particles.scalar(Field::pressure).assign(400, 1.0);
    WallContacts<1> contacts = contacts_of(scene);
    fill_boundary_values(contacts, scene.walls[0], scene.particles, {BoundaryValue::pressure}, closure, 0.0);
    return contacts.pressure.back();
  };
  BOOST_TEST(at_first_particle(1.2, Closure::interpolated) == 1.25, tolerance(0.005));
  BOOST_TEST(at_first_particle(64.0, Closure::interpolated) == 2.0 * std::numbers::ln2, tolerance(1e-4));
  BOOST_TEST(at_first_particle(1.2, Closure::quotient) == 1.0, tolerance(1e-14));
  BOOST_TEST(at_first_particle(64.0, Closure::quotient) == 1.0, tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(quotient_leaves_alone_what_the_wall_prescribes, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = random_scene<Dim>(3, 60);  // walls prescribe all but flux
  WallContacts<Dim> one = contacts_of(scene);
  WallContacts<Dim> other = contacts_of(scene);
  fill_boundary_values(one, scene.walls[0], scene.particles, no_flux, Closure::interpolated, 0.4);
  fill_boundary_values(other, scene.walls[0], scene.particles, no_flux, Closure::quotient, 0.4);
  BOOST_TEST(same_bits(one.pressure, other.pressure));
  BOOST_TEST(same_bits(one.temperature, other.temperature));
  BOOST_TEST(same_bits(one.conductivity, other.conductivity));
  for (int k = 0; k < Dim; ++k) BOOST_TEST(same_bits(one.velocity.component(k), other.velocity.component(k)));
}

// The reference is the Riemann problem between the gas and its mirror image, where the contact is the wall.
BOOST_AUTO_TEST_CASE_TEMPLATE(wall_that_prescribes_velocity_meets_the_pressure_of_its_wave_if_one_sided, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  double const gamma = 1.4;
  bool any_shock = false;
  bool any_fan = false;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    RandomScene<Dim> scene =
        random_scene<Dim>(seed, 60, {BoundaryValue::velocity}, {BoundaryValue::velocity});
    dense::State<Dim> const s(scene);
    for (std::size_t w = 0; w < 2; ++w) {
      Wall<Dim>& wall = scene.walls[w];
      wall.gamma = gamma;
      WallContacts<Dim> contacts = contacts_of(scene, w);
      fill_boundary_values(contacts, wall, scene.particles, every_value, Closure::one_sided, 0.7);
      for (std::size_t c = 0; c < contacts.size(); ++c) {
        Vector<Dim> const foot = s.foot(contacts.particle[c], w);
        Vector<Dim> const v_B = wall.velocity(foot, 0.7);
        DenseGas<Dim> const gas(s, foot);
        double const towards_wall = (gas.v - v_B).dot(wall.outward_normal);
        exact::Riemann const problem({gas.rho, towards_wall, gas.P}, {gas.rho, -towards_wall, gas.P}, gamma);
        BOOST_TEST_REQUIRE(problem.star().has_value());
        BOOST_TEST(contacts.pressure[c] == problem.star()->pressure, tolerance(1e-8));
        BOOST_TEST((contacts.velocity[c] - v_B).norm() < 1e-12);
        any_shock = any_shock || contacts.pressure[c] > 1.1 * gas.P;
        any_fan = any_fan || contacts.pressure[c] < 0.9 * gas.P;
      }
    }
  }
  BOOST_TEST(any_shock);
  BOOST_TEST(any_fan);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(wall_that_prescribes_pressure_goes_with_its_wave_and_lets_the_gas_slip, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  double const gamma = 5.0 / 3.0;
  bool any_shock = false;
  bool any_fan = false;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    RandomScene<Dim> scene =
        random_scene<Dim>(seed, 60, {BoundaryValue::pressure}, {BoundaryValue::pressure});
    dense::State<Dim> const s(scene);
    for (std::size_t w = 0; w < 2; ++w) {
      Wall<Dim>& wall = scene.walls[w];
      wall.gamma = gamma;
      Vector<Dim> const n = wall.outward_normal;
      WallContacts<Dim> contacts = contacts_of(scene, w);
      fill_boundary_values(contacts, wall, scene.particles, every_value, Closure::one_sided, 0.7);
      for (std::size_t c = 0; c < contacts.size(); ++c) {
        Vector<Dim> const foot = s.foot(contacts.particle[c], w);
        DenseGas<Dim> const gas(s, foot);
        double const P_B = wall.pressure(foot, 0.7);
        BOOST_TEST(contacts.pressure[c] == P_B, tolerance(1e-12));
        Vector<Dim> const slip = gas.v - contacts.velocity[c];
        BOOST_TEST((slip - slip.dot(n) * n).norm() < 1e-9);
        double const towards_wall = slip.dot(n);
        exact::Riemann const problem({gas.rho, towards_wall, gas.P}, {gas.rho, -towards_wall, gas.P}, gamma);
        BOOST_TEST_REQUIRE(problem.star().has_value());
        BOOST_TEST(problem.star()->pressure == P_B, tolerance(1e-8));
        any_shock = any_shock || P_B > 1.1 * gas.P;
        any_fan = any_fan || P_B < 0.9 * gas.P;
      }
    }
  }
  BOOST_TEST(any_shock);
  BOOST_TEST(any_fan);
}

// A piston that runs into gas at rest is the case with a sign that nobody can mistake.
BOOST_AUTO_TEST_CASE(one_sided_piston_into_gas_at_rest_raises_the_pressure_and_pressure_drives_it_inwards) {
  double const gamma = 1.4;
  for (double const side : {-1.0, 1.0}) {
    RandomScene<1> scene = lattice_scene<1>(40, 0.05, 1.2);
    scene.particles.scalar(Field::pressure).assign(40, 1.0);
    Wall<1> wall{.point = Vector<1>(side), .outward_normal = Vector<1>(side)};
    wall.gamma = gamma;
    wall.velocity = [side](Vector<1> const&, double) { return Vector<1>(-2.0 * side); };
    scene.walls.push_back(wall);
    WallContacts<1> contacts = contacts_of(scene);
    fill_boundary_values(contacts, wall, scene.particles, {BoundaryValue::pressure}, Closure::one_sided, 0.0);
    double const driven = contacts.pressure[0];
    BOOST_TEST(driven > 1.0 + 0.5 * (gamma + 1.0) * 4.0);
    wall.velocity = {};
    wall.pressure = [driven](Vector<1> const&, double) { return driven; };
    fill_boundary_values(contacts, wall, scene.particles, {BoundaryValue::velocity}, Closure::one_sided, 0.0);
    BOOST_TEST(contacts.velocity[0][0] == -2.0 * side, tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(one_sided_closure_does_not_depend_on_the_frame, D, Dimensions) {
  constexpr int Dim = D::value;
  Random random(9);
  Vector<Dim> const boost = random.vector<Dim>(-20.0, 20.0);
  RandomScene<Dim> scene = random_scene<Dim>(5, 60, {BoundaryValue::velocity}, {BoundaryValue::pressure});
  for (Wall<Dim>& wall : scene.walls) wall.gamma = 1.4;
  RandomScene<Dim> moving = scene;
  for (std::size_t i = 0; i < 60; ++i) moving.particles.vector(Field::velocity).add(i, boost);
  moving.walls[0].velocity = [boost, old = scene.walls[0].velocity](
                                 Vector<Dim> const& x, double t) -> Vector<Dim> { return old(x, t) + boost; };
  constexpr BoundaryValueSet both{BoundaryValue::pressure, BoundaryValue::velocity};
  for (std::size_t w = 0; w < 2; ++w) {
    WallContacts<Dim> one = contacts_of(scene, w);
    WallContacts<Dim> other = contacts_of(moving, w);
    fill_boundary_values(one, scene.walls[w], scene.particles, both, Closure::one_sided, 0.0);
    fill_boundary_values(other, moving.walls[w], moving.particles, both, Closure::one_sided, 0.0);
    BOOST_TEST(relative_difference(other.pressure, one.pressure) < 1e-12);
    for (std::size_t c = 0; c < one.size(); ++c)
      BOOST_TEST((other.velocity[c] - one.velocity[c] - boost).norm() < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(one_sided_closure_interpolates_where_no_gas_is_known_or_no_partner_given, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  constexpr BoundaryValueSet both{BoundaryValue::pressure, BoundaryValue::velocity};
  auto const check = [&](BoundaryValueSet prescribed, double gamma, bool expected) {
    RandomScene<Dim> scene = random_scene<Dim>(7, 60, prescribed, {});
    scene.walls[0].gamma = gamma;
    WallContacts<Dim> one = contacts_of(scene);
    WallContacts<Dim> other = contacts_of(scene);
    fill_boundary_values(one, scene.walls[0], scene.particles, both, Closure::interpolated, 0.0);
    fill_boundary_values(other, scene.walls[0], scene.particles, both, Closure::one_sided, 0.0);
    bool same = same_bits(one.pressure, other.pressure);
    for (int k = 0; k < Dim; ++k)
      same = same && same_bits(one.velocity.component(k), other.velocity.component(k));
    BOOST_TEST(same == expected);
  };
  check({BoundaryValue::velocity}, 0.0, true);
  check({BoundaryValue::pressure}, 0.0, true);
  check({BoundaryValue::velocity}, 1.0, true);
  check({}, 1.4, true);
  check(both, 1.4, true);  // prescribed, both of them
  check({BoundaryValue::velocity}, 1.4, false);
  check({BoundaryValue::pressure}, 1.4, false);
}

/// Contacts with a plane wall, of a lattice of some disorder, by every kernel.
BOOST_AUTO_TEST_CASE_TEMPLATE(contacts_go_by_the_kernel_of_the_particles, D, Dimensions) {
  constexpr int Dim = D::value;
  for (KernelInfo const& info : all_kernel_infos()) {
    for (FaceWeight const rule : {FaceWeight::campbell, FaceWeight::exact, FaceWeight::balanced}) {
      RandomScene<Dim> scene = lattice_scene<Dim>(Dim == 3 ? 10 : 14, 0.1, 1.2);
      Kernel const& W = kernel(info.id, Dim);
      scene.particles.set_kernel(W);
      scene.face_weight = rule;
      Random random(3);
      auto& x = scene.particles.positions();
      for (std::size_t i = 0; i < x.size(); ++i) x.add(i, random.vector<Dim>(-0.02, 0.02));
      for (double& rho : scene.particles.scalar(Field::density)) rho = random.uniform(0.8, 1.2);
      scene.walls.push_back({.point = scene.domain.upper, .outward_normal = Vector<Dim>::Unit(Dim - 1)});
      Wall<Dim> const& wall = scene.walls[0];
      double const h = scene.particles.smoothing_length();
      auto const& m = scene.particles.masses();
      auto const& rho = scene.particles.scalar(Field::density);
      auto const kernel_at = [&](double r) { return written::kernel(info.id, Dim, r, h); };
      WallContacts<Dim> const contacts = contacts_of(scene);
      std::size_t c = 0;
      double worst_density = 0.0, worst_weight = 0.0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        double const d = wall.distance(x[i]);
        if (d >= written::support(info.id) * h) continue;
        BOOST_TEST_REQUIRE(c < contacts.size());
        BOOST_TEST(contacts.particle[c] == i);
        double at_foot = 0.0, balance = 0.0;
        for (std::size_t j = 0; j < x.size(); ++j) {
          at_foot += 2.0 * m[j] * kernel_at((x[j] - wall.foot(x[i])).norm());
          Vector<Dim> const r = x[i] - x[j];
          if (j != i) balance -= m[j] / rho[j] * W.radial(r.norm(), h) * r[Dim - 1];
        }
        double const radius = h * written::half_chord(written::support(info.id), d / h);
        double const area = Dim == 1 ? 1.0 : Dim == 2 ? 2.0 * radius : std::numbers::pi * radius * radius;
        double const weight = rule == FaceWeight::campbell ? kernel_at(d) * area
                              : rule == FaceWeight::exact  ? written::plane_integral(info.id, Dim, d / h) / h
                                                           : balance;
        worst_density = std::max(worst_density, std::abs(contacts.foot_density[c] - at_foot));
        worst_weight = std::max(worst_weight, h * std::abs(contacts.face_weight[c] - weight));
        ++c;
      }
      BOOST_TEST(contacts.size() == c);
      BOOST_TEST(c > 0u);
      BOOST_TEST(worst_density < 1e-13, info.id);
      BOOST_TEST(worst_weight < 1e-13, info.id);
    }
  }
}

BOOST_AUTO_TEST_CASE(threads_change_neither_contacts_nor_what_closures_fill_in_nor_who_is_complained_of) {
  RandomScene<2> scene = random_slab<2>(17, 9000);  // more than are looked at together
  SmoothingLength const h(0.03, default_kernel(2));
  CellGrid<2> const grid(scene.particles.positions(), scene.domain, h.kernel().support_ratio() * h.largest());
  auto const found = [&](int threads) {
    WallContacts<2> contacts = find_wall_contacts(grid, scene.walls[1], scene.walls, h, scene.particles.masses(),
                                                  scene.particles.scalar(Field::density), FaceWeight::balanced, threads);
    fill_boundary_values(contacts, scene.walls[1], scene.particles, {BoundaryValue::pressure, BoundaryValue::velocity},
                         Closure::quotient, 0.0, threads);
    return contacts;
  };
  WallContacts<2> const one = found(1);
  BOOST_TEST(one.size() > 300u);
  BOOST_TEST(std::is_sorted(one.particle.begin(), one.particle.end()));
  for (int const threads : {2, 3}) {
    WallContacts<2> const several = found(threads);
    BOOST_TEST((several.particle == one.particle));
    BOOST_TEST((several.face_weight == one.face_weight));
    BOOST_TEST((several.foot_density == one.foot_density));
    BOOST_TEST((several.interpolation_first == one.interpolation_first));
    BOOST_TEST((several.interpolation_neighbour == one.interpolation_neighbour));
    BOOST_TEST((several.interpolation_kernel == one.interpolation_kernel));
    BOOST_TEST((several.pressure == one.pressure));
    for (int k = 0; k < 2; ++k) {
      BOOST_TEST((several.foot.component(k) == one.foot.component(k)));
      BOOST_TEST((several.velocity.component(k) == one.velocity.component(k)));
    }
  }
  scene.particles.positions().set(8000, Vector<2>(1.5, 0.5));
  scene.particles.positions().set(5000, Vector<2>(1.5, 0.5));
  for (int const threads : {1, 2}) {
    BOOST_CHECK_EXCEPTION(found(threads), std::invalid_argument, [](std::invalid_argument const& error) {
      return std::string(error.what()).find("particle 5000 lies on or outside") == 0;
    });
  }
}

BOOST_AUTO_TEST_SUITE_END()
