// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/wall_particles/dummy.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <set>

#include "formulations/rate_operator.hpp"
#include "formulations/wall_particles/all.hpp"
#include "tests/support/cell_scenes.hpp"

BOOST_AUTO_TEST_SUITE(formulations_wall_particles_dummy)

using namespace sphverify;
using namespace sphverify::tests;

template <int Dim>
struct Layered {
  Domain<Dim> domain;
  Particles<Dim> particles{0, 1.0};
  PairGeometry<Dim> geometry;
  double spacing = 0.0;
  std::vector<PlacedBehind<Dim>> placed;

  Layered(Sides sides, double jitter, bool turned = false) : domain(box_of<Dim>(sides, turned)) {
    for (int k = 0; k < Dim; ++k) domain.upper[k] = domain.lower[k] + 1.0;
    Layout<Dim> const layout = jittered(domain, 10, jitter, 2);
    spacing = layout.spacing;
    particles = Particles<Dim>(layout.volumes.size(), 1.2 * spacing);
    particles.positions() = layout.positions;
    particles.allocate({Field::density, Field::pressure, Field::velocity, Field::temperature, Field::conductivity, Field::acceleration,
                        Field::heating});
    for (std::size_t i = 0; i < particles.size(); ++i) {
      particles.scalar(Field::density)[i] = 1.5;
      particles.masses()[i] = 1.5 * std::pow(spacing, Dim);
      particles.scalar(Field::pressure)[i] = 2.0;
      particles.scalar(Field::temperature)[i] = 3.0;
      particles.scalar(Field::conductivity)[i] = 1.0;
      particles.vector(Field::velocity).set(i, Vector<Dim>::Zero());
    }
    geometry.domain = domain;
    geometry.walls = walls_of(domain);
  }

  void stand() {
    SmoothingLength const h(particles);
    CellGrid<Dim> const grid(particles.positions(), domain, h.support(0));
    geometry.neighbours = find_neighbours(grid);
    for (Wall<Dim> const& wall : geometry.walls)
      geometry.contacts.push_back(find_wall_contacts(grid, wall, geometry.walls, h, particles.masses(),
                                                     particles.scalar(Field::density), FaceWeight::exact));
    placed = DummyWalls::place<Dim>({particles, domain, geometry.walls, grid, spacing});
    geometry.behind = stand_behind_walls(placed, geometry.contacts, particles, domain);
  }
};

/// A lattice goes on behind its walls and beyond its corners: a uniform gas there is as in the middle.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_uniform_gas_on_a_lattice_is_at_rest_between_dummies, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Sides const sides : {Sides::walls, Sides::mixed}) {
    for (bool const turned : {false, Dim > 1}) {
      Layered<Dim> scene(sides, 0.0, turned);
      for (Wall<Dim>& wall : scene.geometry.walls) wall.velocity = [](Vector<Dim> const&, double) { return Vector<Dim>::Zero().eval(); };
      scene.stand();
      for (char const* id : {"momentum/p-rho2", "momentum/sqrt-p"}) {
        auto const push = make_rate_operator<Dim>(id);
        WorkCount work;
        push->evaluate(scene.particles, scene.geometry, Closure::interpolated, 0.0, 1, work);
        for (std::size_t i = 0; i < scene.particles.size(); ++i)
          BOOST_TEST(scene.particles.vector(Field::acceleration)[i].norm() < 1e-11 * 2.0 / (1.5 * scene.spacing));
      }
    }
  }
}

/// Where they stand: layers as deep as the support, each lattice place once, none inside.
BOOST_AUTO_TEST_CASE_TEMPLATE(layers_are_as_deep_as_the_support_and_nothing_stands_twice, D, Dimensions) {
  constexpr int Dim = D::value;
  Layered<Dim> scene(Sides::walls, 0.2);
  scene.stand();
  std::set<std::vector<long>> seen;
  double deepest = 0.0;
  for (PlacedBehind<Dim> const& one : scene.placed) {
    std::vector<long> cell;
    bool is_outside = false;
    for (int k = 0; k < Dim; ++k) {
      double const at = (one.position[k] - scene.domain.lower[k]) / scene.spacing - 0.5;
      BOOST_TEST(std::abs(at - std::round(at)) < 1e-9);
      cell.push_back(std::lround(at));
      is_outside = is_outside || cell.back() < 0 || cell.back() >= 10;
    }
    BOOST_TEST(is_outside);
    BOOST_TEST(seen.insert(cell).second);
    double sum = 0.0;
    for (auto const& [j, weight] : one.sources) sum += weight;
    BOOST_TEST(std::abs(sum - 1.0) < 1e-13);
    BOOST_TEST(one.volume == std::pow(scene.spacing, Dim), boost::test_tools::tolerance(1e-12));
    for (int m = 0; m < one.mirror_count; ++m) deepest = std::max(deepest, one.mirrors[static_cast<std::size_t>(m)].behind);
  }
  BOOST_TEST(deepest > 1.4 * scene.spacing);
  BOOST_TEST(deepest < 2.4 * scene.spacing);
}

/// T_w = 2 T_B - T~ with Shepard's mean of the fluid, P_w = P~, m_w = rho~ dx^D, by a sum over all particles.
BOOST_AUTO_TEST_CASE_TEMPLATE(values_are_shepards_means_of_the_fluid_continued, D, Dimensions) {
  constexpr int Dim = D::value;
  Layered<Dim> scene(Sides::walls, 0.3);
  Random random(6);
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    for (Field const field : {Field::temperature, Field::pressure, Field::density}) scene.particles.scalar(field)[i] = random.uniform(1.0, 2.0);
  }
  for (Wall<Dim>& wall : scene.geometry.walls) wall.temperature = [](Vector<Dim> const&, double time) { return 7.0 + time; };
  scene.stand();
  Kernel const& kernel = scene.particles.kernel();
  double const h = scene.particles.smoothing_length();
  std::size_t looked_at = 0;
  for (std::size_t w = 0; w < scene.geometry.walls.size(); ++w) {
    WallParticles<Dim>& behind = scene.geometry.behind[w];
    fill_wall_particles(behind, scene.geometry.contacts[w], scene.geometry.walls, scene.particles,
                        {Field::temperature, Field::pressure, Field::mass}, 0.5);
    for (std::size_t k = 0; k < behind.placed.size(); ++k) {
      std::size_t const at = scene.geometry.contacts[w].size() + k;
      Vector<Dim> const x = behind.particles.positions()[at];
      double weight = 0.0, T = 0.0, P = 0.0, rho = 0.0;
      for (std::size_t j = 0; j < scene.particles.size(); ++j) {
        double const W = kernel.value((x - scene.particles.positions()[j]).norm(), h);
        weight += W;
        T += W * scene.particles.scalar(Field::temperature)[j];
        P += W * scene.particles.scalar(Field::pressure)[j];
        rho += W * scene.particles.scalar(Field::density)[j];
      }
      T /= weight;
      // Once for each wall behind which it is: 2 T_B - T, then T again.
      double const continued = behind.placed[k].mirror_count % 2 == 1 ? 15.0 - T : T;
      BOOST_TEST(std::abs(behind.particles.scalar(Field::temperature)[at] - continued) < 1e-12);
      BOOST_TEST(std::abs(behind.particles.scalar(Field::pressure)[at] - P / weight) < 1e-12);
      BOOST_TEST(std::abs(behind.particles.masses()[at] - rho / weight * std::pow(scene.spacing, Dim)) < 1e-12);
      ++looked_at;
    }
  }
  BOOST_TEST(looked_at > 3u);
}

/// Where walls have the temperatures of a linear field, a dummy has its sources' mean and twice the way into each wall, times the
/// slope; in corners too, whatever the order of the walls.
BOOST_AUTO_TEST_CASE(dummies_beyond_corners_go_through_one_wall_after_the_other) {
  Layered<2> scene(Sides::walls, 0.2);
  Vector<2> const slope(1.5, -0.7);
  auto const T = [slope](Vector<2> const& x) { return 4.0 + slope.dot(x); };
  for (std::size_t i = 0; i < scene.particles.size(); ++i) scene.particles.scalar(Field::temperature)[i] = T(scene.particles.positions()[i]);
  for (Wall<2>& wall : scene.geometry.walls) wall.temperature = [T](Vector<2> const& foot, double) { return T(foot); };
  scene.stand();
  std::size_t in_corners = 0;
  for (std::size_t w = 0; w < scene.geometry.walls.size(); ++w) {
    WallParticles<2>& behind = scene.geometry.behind[w];
    fill_wall_particles(behind, scene.geometry.contacts[w], scene.geometry.walls, scene.particles, {Field::temperature}, 0.0);
    for (std::size_t k = 0; k < behind.placed.size(); ++k) {
      if (behind.placed[k].mirror_count != 2) continue;
      ++in_corners;
      std::size_t const at = scene.geometry.contacts[w].size() + k;
      Vector<2> const x = behind.particles.positions()[at];
      Vector<2> mean = Vector<2>::Zero();
      for (auto const& [j, weight] : behind.placed[k].sources) mean += weight * scene.particles.positions()[j];
      double expected = T(mean);
      for (int axis = 0; axis < 2; ++axis) {
        double const wall = x[axis] < scene.domain.lower[axis] ? scene.domain.lower[axis] : scene.domain.upper[axis];
        expected += 2.0 * slope[axis] * (x[axis] - wall);
      }
      BOOST_TEST(std::abs(behind.particles.scalar(Field::temperature)[at] - expected) < 1e-12);
    }
  }
  BOOST_TEST(in_corners >= 4u);
}

/// A wall that has moved takes its layers along.
BOOST_AUTO_TEST_CASE(layers_go_with_their_wall) {
  Layered<1> scene(Sides::walls, 0.0);
  double const moved = 0.021;
  scene.geometry.walls[1].point[0] += moved;
  scene.stand();
  std::vector<double> above;
  for (auto const& one : scene.placed) {
    if (one.booked_to() == 1) above.push_back(one.position[0] - scene.domain.upper[0] - moved);
  }
  std::sort(above.begin(), above.end());
  BOOST_TEST_REQUIRE(above.size() >= 2u);
  BOOST_TEST(std::abs(above[0] - 0.5 * scene.spacing) < 1e-14);
  BOOST_TEST(std::abs(above[1] - 1.5 * scene.spacing) < 1e-14);
}

struct NoWalls {
  static constexpr WallTreatmentInfo info{.id = "on", .title = "", .source = "", .equation = "", .remarks = ""};
  template <int Dim>
  static std::vector<PlacedBehind<Dim>> place(WallSurroundings<Dim> const&) {
    return {};
  }
};

BOOST_AUTO_TEST_CASE(a_name_is_taken_once) {
  BOOST_CHECK_THROW(add_wall_treatment(wall_treatment_part<MirrorWalls>()), std::invalid_argument);
  BOOST_CHECK_THROW(add_wall_treatment(wall_treatment_part<NoWalls>()), std::invalid_argument);
  BOOST_TEST(all_wall_treatments().size() == std::tuple_size_v<AllWallTreatments>);
  BOOST_TEST((find_wall_treatment("dummy") != nullptr));
  BOOST_TEST((find_wall_treatment("off") == nullptr));
}

BOOST_AUTO_TEST_SUITE_END()
