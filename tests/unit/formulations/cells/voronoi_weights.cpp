// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/cells/voronoi_weights.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <memory>

#include "formulations/rate_operator.hpp"
#include "tests/support/cell_scenes.hpp"

BOOST_AUTO_TEST_SUITE(formulations_cells_voronoi_weights)

using namespace sphverify;
using namespace sphverify::tests;

/// Particles of a scene with masses of any size, at the densities of their cells, and the geometry of their faces.
template <int Dim>
struct WeighedScene {
  Particles<Dim> particles;
  PairGeometry<Dim> geometry;
  VoronoiCells<Dim> cells;

  WeighedScene(CellScene<Dim> const& scene, double smoothing_length)
      : particles(scene.positions.size(), smoothing_length), cells(scene.cells()) {
    Random random(21);
    particles.positions() = scene.positions;
    particles.allocate({Field::density, Field::temperature, Field::conductivity, Field::heating, Field::pressure, Field::velocity,
                        Field::acceleration});
    for (std::size_t i = 0; i < particles.size(); ++i) {
      particles.masses()[i] = random.uniform(0.5, 2.0) * cells.volume[i];
      particles.scalar(Field::density)[i] = particles.masses()[i] / cells.volume[i];
    }
    geometry.domain = scene.domain;
    geometry.walls = scene.walls;
  }

  void weigh() {
    SmoothingLength const h(particles);
    double reach = h.kernel().support_ratio() * h.largest();
    CellGrid<Dim> const grid(particles.positions(), geometry.domain, reach);
    weigh_by_cells(geometry, VoronoiCells<Dim>(cells), grid, h, particles.masses(), particles.scalar(Field::density), 1);
  }

  std::vector<double> rate(std::string_view id, bool frozen = false, Closure closure = Closure::interpolated) {
    auto const scheme = make_rate_operator<Dim>(id);
    particles.allocate(needed_fields(scheme->info()));
    if (frozen) scheme->freeze(particles, geometry, 1);
    WorkCount work;
    scheme->evaluate(particles, geometry, closure, 0.0, 1, work);
    powers = scheme->wall_power();
    return particles.scalar(Field::heating);
  }
  std::vector<double> powers;
};

/// What a rate is measured by: the sum of all that flows.
template <int Dim>
double flowing(WeighedScene<Dim> const& scene, std::size_t i, double difference) {
  auto const& list = scene.geometry.neighbours;
  double sum = 0.0;
  for (std::size_t k = list.first[i]; k < list.first[i + 1]; ++k)
    sum += scene.cells.area[k] / scene.geometry.domain
                                     .nearest_image(scene.particles.positions()[i] - scene.particles.positions()[list.neighbour[k]])
                                     .norm();
  for (std::size_t w = 0; w < scene.geometry.contacts.size(); ++w) {
    for (std::size_t c = 0; c < scene.geometry.contacts[w].size(); ++c) {
      if (scene.geometry.contacts[w].particle[c] == i) sum += scene.cells.walls[w].area[c] / scene.geometry.contacts[w].distance[c];
    }
  }
  return difference * sum / scene.particles.masses()[i];
}

/// Temperatures that are linear conduct exactly, between walls of given temperature and in their corners, on any particles
/// and for any densities; so do walls their flux.
BOOST_AUTO_TEST_CASE_TEMPLATE(linear_temperatures_are_steady_on_any_particles, D, Dimensions) {
  constexpr int Dim = D::value;
  for (CellScene<Dim> const& scene : cell_scenes<Dim>()) {
    if (scene.walls.size() < 2 * static_cast<std::size_t>(Dim)) continue;
    WeighedScene<Dim> weighed(scene, 0.05);
    Vector<Dim> slope;
    for (int k = 0; k < Dim; ++k) slope[k] = 1.0 - 0.7 * k;
    auto const T = [slope](Vector<Dim> const& x) { return 3.0 + slope.dot(x); };
    for (Wall<Dim>& wall : weighed.geometry.walls) {
      wall.temperature = [T](Vector<Dim> const& foot, double) { return T(foot); };
      wall.conductivity = [](Vector<Dim> const&, double) { return 1.7; };
    }
    for (std::size_t i = 0; i < weighed.particles.size(); ++i) {
      weighed.particles.scalar(Field::temperature)[i] = T(scene.positions[i]);
      weighed.particles.scalar(Field::conductivity)[i] = 1.7;
    }
    weighed.weigh();
    for (bool const frozen : {false, true}) {
      std::vector<double> const rate = weighed.rate("conduction/brookshaw", frozen);
      double worst = 0.0;
      for (std::size_t i = 0; i < rate.size(); ++i) worst = std::max(worst, std::abs(rate[i]) / flowing(weighed, i, 1.7 * 4.0));
      BOOST_TEST(worst < 1e-12, scene.name << ": " << worst);
      for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        double area = 0.0;
        double rounding = 0.0;  // of temperatures, over the distances from the wall
        for (std::size_t c = 0; c < weighed.cells.walls[w].area.size(); ++c) {
          area += weighed.cells.walls[w].area[c];
          rounding += 1e-15 * 4.0 * 1.7 * weighed.cells.walls[w].area[c] / weighed.geometry.contacts[w].distance[c];
        }
        double const into = 1.7 * slope.dot(scene.walls[w].outward_normal) * area;
        BOOST_TEST(std::abs(weighed.powers[w] - into) < 1e-12 * area + rounding, scene.name);
      }
    }
  }
}

/// m_i times the conductance is a_ij/r_ij (K_i + K_j)/2 whatever the densities, from both sides.
BOOST_AUTO_TEST_CASE_TEMPLATE(conductances_are_two_point_fluxes_of_the_cells, D, Dimensions) {
  constexpr int Dim = D::value;
  for (CellScene<Dim> const& scene : cell_scenes<Dim>()) {
    WeighedScene<Dim> weighed(scene, 0.05);
    Random random(4);
    for (std::size_t i = 0; i < weighed.particles.size(); ++i) {
      weighed.particles.scalar(Field::temperature)[i] = random.uniform(1.0, 2.0);
      weighed.particles.scalar(Field::conductivity)[i] = random.uniform(0.1, 10.0);
      weighed.particles.scalar(Field::density)[i] *= random.uniform(0.3, 3.0);
    }
    weighed.weigh();
    weighed.geometry.contacts.clear();
    std::vector<double> const rate = weighed.rate("conduction/brookshaw");
    NeighbourList const& list = weighed.geometry.neighbours;
    auto const& T = weighed.particles.scalar(Field::temperature);
    auto const& K = weighed.particles.scalar(Field::conductivity);
    double worst = 0.0;
    for (std::size_t i = 0; i < rate.size(); ++i) {
      double sum = 0.0;
      double size = 0.0;
      for (std::size_t k = list.first[i]; k < list.first[i + 1]; ++k) {
        std::size_t const j = list.neighbour[k];
        double const r = scene.domain.nearest_image(scene.positions[i] - scene.positions[j]).norm();
        double const flow = 0.5 * (K[i] + K[j]) * weighed.cells.area[k] / r * (T[j] - T[i]);
        sum += flow;
        size += std::abs(flow);
      }
      worst = std::max(worst, std::abs(rate[i] * weighed.particles.masses()[i] - sum) / size);
    }
    BOOST_TEST(worst < 1e-13, scene.name << ": " << worst);
  }
}

/// Closed faces push nothing where pressure is uniform: neither between particles nor at walls that prescribe it.
BOOST_AUTO_TEST_CASE_TEMPLATE(uniform_pressure_moves_no_particle_anywhere, D, Dimensions) {
  constexpr int Dim = D::value;
  for (CellScene<Dim> const& scene : cell_scenes<Dim>()) {
    WeighedScene<Dim> weighed(scene, 0.05);
    for (std::size_t i = 0; i < weighed.particles.size(); ++i) {
      weighed.particles.masses()[i] = 1.3 * weighed.cells.volume[i];
      weighed.particles.scalar(Field::density)[i] = 1.3;
      weighed.particles.scalar(Field::pressure)[i] = 2.0;
    }
    for (Wall<Dim>& wall : weighed.geometry.walls) wall.pressure = [](Vector<Dim> const&, double) { return 2.0; };
    weighed.weigh();
    for (char const* id : {"momentum/p-rho2", "momentum/direct-gradient", "momentum/sqrt-p"}) {
      auto const scheme = make_rate_operator<Dim>(id);
      WorkCount work;
      scheme->evaluate(weighed.particles, weighed.geometry, Closure::quotient, 0.0, 1, work);
      double worst = 0.0;
      for (std::size_t i = 0; i < weighed.particles.size(); ++i) {
        double surface = 0.0;
        for (std::size_t k = weighed.geometry.neighbours.first[i]; k < weighed.geometry.neighbours.first[i + 1]; ++k)
          surface += weighed.cells.area[k];
        worst = std::max(worst, weighed.particles.vector(Field::acceleration)[i].norm() * weighed.particles.masses()[i] / surface);
      }
      BOOST_TEST(worst < 1e-11, scene.name << ", " << id << ": " << worst);
    }
  }
}

/// The smoothing length enters nothing that the faces replace.
BOOST_AUTO_TEST_CASE_TEMPLATE(smoothing_lengths_and_kernels_change_no_bit, D, Dimensions) {
  constexpr int Dim = D::value;
  CellScene<Dim> const scene = cell_scenes<Dim>()[2];
  std::vector<double> first;
  for (double const h : {0.02, 0.11}) {
    for (char const* id : {"cubic-spline", "wendland-c4"}) {
      WeighedScene<Dim> weighed(scene, h);
      weighed.particles.set_kernel(kernel(id, Dim));
      Random random(9);
      for (std::size_t i = 0; i < weighed.particles.size(); ++i) {
        weighed.particles.scalar(Field::temperature)[i] = random.uniform(1.0, 2.0);
        weighed.particles.scalar(Field::conductivity)[i] = random.uniform(0.1, 10.0);
      }
      for (Wall<Dim>& wall : weighed.geometry.walls) {
        wall.temperature = [](Vector<Dim> const& foot, double) { return foot.sum(); };
        wall.conductivity = [](Vector<Dim> const&, double) { return 2.0; };
      }
      weighed.weigh();
      std::vector<double> const rate = weighed.rate("conduction/brookshaw");
      if (first.empty()) first = rate;
      BOOST_TEST(same_bits(rate, first));
    }
  }
}

/// A closure at a wall finds at least the particle itself, however small the support.
BOOST_AUTO_TEST_CASE(a_wall_beyond_the_support_has_what_its_particle_has) {
  CellScene<2> const scene = cell_scenes<2>()[3];
  WeighedScene<2> weighed(scene, 1e-4);
  for (std::size_t i = 0; i < weighed.particles.size(); ++i) {
    weighed.particles.scalar(Field::temperature)[i] = static_cast<double>(i);
    weighed.particles.scalar(Field::conductivity)[i] = 1.0;
  }
  weighed.weigh();
  for (std::size_t w = 0; w < weighed.geometry.walls.size(); ++w) {
    WallContacts<2>& contacts = weighed.geometry.contacts[w];
    BOOST_TEST_REQUIRE(contacts.size() > 5u);
    fill_boundary_values(contacts, weighed.geometry.walls[w], weighed.particles, {BoundaryValue::temperature}, Closure::interpolated, 0.0);
    for (std::size_t c = 0; c < contacts.size(); ++c)
      BOOST_TEST(std::abs(contacts.temperature[c] - static_cast<double>(contacts.particle[c])) < 1e-12 * contacts.particle[c] + 1e-300);
  }
}

BOOST_AUTO_TEST_SUITE_END()
