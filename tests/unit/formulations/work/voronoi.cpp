// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/support/cell_gas.hpp"

BOOST_AUTO_TEST_SUITE(formulations_work_voronoi)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "work/voronoi";

/// Along their normals, each at a speed of its own.
template <int Dim>
void move_walls(CellGas<Dim>& gas) {
  for (std::size_t w = 0; w < gas.geometry.walls.size(); ++w) {
    Vector<Dim> const v = (0.3 - 0.2 * static_cast<double>(w)) * gas.geometry.walls[w].outward_normal;
    gas.geometry.walls[w].velocity = [v](Vector<Dim> const&, double) { return v; };
  }
}

/// -P_i dV_i/dt by differences of volumes, with walls that move too.
BOOST_AUTO_TEST_CASE_TEMPLATE(work_is_that_of_the_changing_volume, D, Dimensions) {
  constexpr int Dim = D::value;
  for (CellScene<Dim> const& scene : small_cell_scenes<Dim>()) {
    CellGas<Dim> gas(scene);
    gas.give_walls_the_pressure_of_their_particles();
    move_walls(gas);
    gas.find_faces();
    gas.evaluate(id);
    double const step = 1e-6 * std::pow(gas.volume[0], 1.0 / Dim);
    std::vector<double> expected(gas.volume.size(), 0.0);
    for (double const side : {-1.0, 1.0}) {
      VectorField<Dim> moved = scene.positions;
      for (std::size_t i = 0; i < moved.size(); ++i)
        moved.add(i, side * step * gas.particles.vector(Field::velocity)[i]);
      std::vector<Wall<Dim>> walls = gas.geometry.walls;
      for (Wall<Dim>& wall : walls) wall.point += side * step * wall.velocity(wall.point, 0.0);
      std::vector<double> const volume = voronoi_volumes(moved, scene.domain, walls, 1);
      for (std::size_t i = 0; i < volume.size(); ++i)
        expected[i] -=
            gas.particles.scalar(Field::pressure)[i] * side * (volume[i] - gas.volume[i]) / (2.0 * step);
    }
    double worst = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i)
      worst = std::max(worst, std::abs(gas.power(i) - expected[i]) / gas.surface[i]);
    BOOST_TEST(worst < 1e-7, scene.name << ": " << worst);
  }
}

/// Kinetic and internal energy together change by what the walls' forces do on the walls' velocities,
/// whatever these prescribe.
BOOST_AUTO_TEST_CASE_TEMPLATE(energy_is_that_of_the_forces_of_walls, D, Dimensions) {
  constexpr int Dim = D::value;
  for (CellScene<Dim> const& scene : cell_scenes<Dim>()) {
    CellGas<Dim> gas(scene);
    for (Wall<Dim>& wall : gas.geometry.walls)
      wall.pressure = [](Vector<Dim> const& x, double) { return 2.0 + std::sin(3.0 * x.sum()); };
    move_walls(gas);
    gas.find_faces();
    auto const momentum = gas.evaluate("momentum/voronoi");
    gas.evaluate(id);
    double net = 0.0;
    double gross = 0.0;
    for (std::size_t i = 0; i < gas.volume.size(); ++i) {
      double const kinetic = gas.force(i).dot(gas.particles.vector(Field::velocity)[i]);
      net += kinetic + gas.power(i);
      gross += std::abs(kinetic) + std::abs(gas.power(i));
    }
    for (std::size_t w = 0; w < scene.walls.size(); ++w)
      net -= momentum->wall_force()[w].dot(gas.geometry.walls[w].velocity(scene.walls[w].point, 0.0));
    BOOST_TEST(std::abs(net) < 1e-13 * gross, scene.name << ": " << net / gross);
  }
}

BOOST_AUTO_TEST_SUITE_END()
