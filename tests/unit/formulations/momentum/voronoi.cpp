// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "tests/support/cell_gas.hpp"

BOOST_AUTO_TEST_SUITE(formulations_momentum_voronoi)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::string_view id = "momentum/voronoi";

/// -d/dr_i of the energy of all cells, dE_k = -P_k dV_k, by differences of volumes: neither areas nor
/// centroids enter.
BOOST_AUTO_TEST_CASE_TEMPLATE(forces_are_those_of_the_energy_of_the_cells, D, Dimensions) {
  constexpr int Dim = D::value;
  for (CellScene<Dim> const& scene : small_cell_scenes<Dim>()) {
    CellGas<Dim> gas(scene);
    gas.give_walls_the_pressure_of_their_particles();
    gas.find_faces();
    gas.evaluate(id);
    double const step = 1e-6 * std::pow(gas.volume[0], 1.0 / Dim);
    double worst = 0.0;
    for (std::size_t i = 0; i < gas.volume.size(); ++i) {
      Vector<Dim> expected = Vector<Dim>::Zero();
      for (int k = 0; k < Dim; ++k) {
        for (double const side : {-1.0, 1.0}) {
          VectorField<Dim> moved = scene.positions;
          moved.add(i, side * step * Vector<Dim>::Unit(k));
          std::vector<double> const volume = voronoi_volumes(moved, scene.domain, scene.walls, 1);
          for (std::size_t j = 0; j < volume.size(); ++j)
            expected[k] +=
                gas.particles.scalar(Field::pressure)[j] * side * (volume[j] - gas.volume[j]) / (2.0 * step);
        }
      }
      worst = std::max(worst, (gas.force(i) - expected).norm() / gas.surface[i]);
    }
    BOOST_TEST(worst < 1e-7, scene.name << ": " << worst);
  }
}

/// Up to the walls that prescribe it and in their corners, on any particles.
BOOST_AUTO_TEST_CASE_TEMPLATE(linear_pressure_gives_its_gradient_on_any_particles, D, Dimensions) {
  constexpr int Dim = D::value;
  for (CellScene<Dim> const& scene : cell_scenes<Dim>()) {
    if (scene.walls.size() < 2 * static_cast<std::size_t>(Dim)) continue;
    CellGas<Dim> gas(scene);
    Vector<Dim> gradient;
    for (int k = 0; k < Dim; ++k) gradient[k] = 1.0 - 0.7 * k;
    auto const P = [gradient](Vector<Dim> const& x) { return 3.0 + gradient.dot(x); };
    for (Wall<Dim>& wall : gas.geometry.walls)
      wall.pressure = [P](Vector<Dim> const& foot, double) { return P(foot); };
    for (std::size_t i = 0; i < gas.volume.size(); ++i)
      gas.particles.scalar(Field::pressure)[i] = P(scene.positions[i]);
    gas.find_faces();
    gas.evaluate(id);
    double worst = 0.0;
    for (std::size_t i = 0; i < gas.volume.size(); ++i)
      worst = std::max(worst, (gas.force(i) + gas.volume[i] * gradient).norm() / (4.0 * gas.surface[i]));
    BOOST_TEST(worst < 1e-12, scene.name << ": " << worst);
  }
}

/// Whatever the closure finds, where it finds constants; a wall feels its pressure on all of its area.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_uniform_gas_stays_at_rest_between_walls_of_either_kind, D, Dimensions) {
  constexpr int Dim = D::value;
  for (CellScene<Dim> const& scene : cell_scenes<Dim>()) {
    for (bool const prescribes_pressure : {false, true}) {
      for (Closure const closure : {Closure::quotient, Closure::one_sided}) {
        CellGas<Dim> gas(scene);
        gas.particles.scalar(Field::pressure).assign(gas.volume.size(), 2.0);
        for (std::size_t i = 0; i < gas.volume.size(); ++i)
          gas.particles.vector(Field::velocity).set(i, Vector<Dim>::Zero());
        for (Wall<Dim>& wall : gas.geometry.walls) {
          wall.gamma = 1.4;
          if (prescribes_pressure)
            wall.pressure = [](Vector<Dim> const&, double) { return 2.0; };
          else
            wall.velocity = [](Vector<Dim> const&, double) -> Vector<Dim> { return Vector<Dim>::Zero(); };
        }
        gas.find_faces();
        auto const form = gas.evaluate(id, closure);
        double worst = 0.0;
        for (std::size_t i = 0; i < gas.volume.size(); ++i)
          worst = std::max(worst, gas.force(i).norm() / gas.surface[i]);
        BOOST_TEST(worst < 1e-11, scene.name << ": " << worst);
        for (std::size_t w = 0; w < scene.walls.size(); ++w) {
          double area = 1.0;
          for (int k = 0; k < Dim; ++k) {
            if (std::abs(scene.domain.axes.col(k).dot(scene.walls[w].outward_normal)) < 0.5)
              area *= scene.domain.extent()[k];
          }
          double const deviation =
              (form->wall_force()[w] + 2.0 * area * scene.walls[w].outward_normal).norm();
          BOOST_TEST(deviation < 1e-11 * area, scene.name << ": " << deviation);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_wall_gets_what_it_prescribes_on_all_of_its_area_whatever_the_gas, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  for (CellScene<Dim> const& scene : small_cell_scenes<Dim>()) {
    CellGas<Dim> gas(scene);
    for (Wall<Dim>& wall : gas.geometry.walls) wall.pressure = [](Vector<Dim> const&, double) { return 5.0; };
    gas.find_faces();
    auto const form = gas.evaluate(id);
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
      Vector<Dim> const n = scene.walls[w].outward_normal;
      double area = 1.0;
      for (int k = 0; k < Dim; ++k) {
        if (std::abs(scene.domain.axes.col(k).dot(n)) < 0.5) area *= scene.domain.extent()[k];
      }
      BOOST_TEST(form->wall_force()[w].dot(n) == -5.0 * area, boost::test_tools::tolerance(1e-12));
    }
  }
}

/// Three particles between walls at 0 and 1, by hand: a_i = -(P_{i+1} - P_{i-1})/(2 m_i) inside, the wall's
/// pressure whole.
BOOST_AUTO_TEST_CASE(three_particles_on_a_line_have_the_forces_of_a_hand_calculation) {
  Domain<1> domain;
  domain.lower[0] = 0.0;
  domain.upper[0] = 1.0;
  VectorField<1> places(3);
  places.set(0, Vector<1>(0.1));
  places.set(1, Vector<1>(0.5));
  places.set(2, Vector<1>(0.7));
  CellGas<1> gas({"three", domain, walls_of(domain), places});
  gas.particles.scalar(Field::pressure) = {1.0, 3.0, 7.0};
  gas.geometry.walls[0].pressure = [](Vector<1> const&, double) { return 11.0; };
  gas.geometry.walls[1].pressure = [](Vector<1> const&, double) { return 13.0; };
  gas.find_faces();
  gas.evaluate(id);
  BOOST_TEST(gas.force(0)[0] == 11.0 - 2.0, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(gas.force(1)[0] == 2.0 - 5.0, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(gas.force(2)[0] == 5.0 - 13.0, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(pairs_of_a_kernel_are_refused_by_name) {
  RandomScene<2> const scene = random_scene<2>(1, 20);
  auto const names = [](UndefinedRate const& error) {
    return std::string(error.what()).find("momentum/voronoi pushes through faces of cells") !=
           std::string::npos;
  };
  BOOST_CHECK_EXCEPTION(sphverify::claims::evaluate(scene, id, geometry_of(scene)), UndefinedRate, names);
  RandomScene<2> const alone = random_scene<2>(1, 1);
  BOOST_CHECK_EXCEPTION(sphverify::claims::evaluate(alone, id, geometry_of(alone)), UndefinedRate, names);
}

BOOST_AUTO_TEST_SUITE_END()
