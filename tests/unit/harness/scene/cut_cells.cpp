// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/scene/cut_cells.hpp"

#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numeric>
#include <tuple>

#include "cases/support/case.hpp"
#include "harness/scene/moving_scene.hpp"
#include "harness/scene/place.hpp"

BOOST_AUTO_TEST_SUITE(harness_scene_cut_cells)

using namespace sphverify;

template <int Dim>
Problem<Dim> problem_of(char const* id, std::vector<std::pair<std::string, ParameterValue>> const& values) {
  Case const* const one = find_case(id);
  Parameters parameters(one->info.parameters);
  for (auto const& [name, value] : values) parameters.set(name, value);
  return std::get<Problem<Dim>>(one->problem(parameters));
}

std::vector<LayoutChoice> const on_a_line{{"lattice"},      {"jittered", 0.3, 1}, {"jittered", 0.3, 2},
                                          {"clumped", 0.1}, {"touching", 0.01},   {"equal-mass"}};

struct Whole {
  double mass, momentum, energy;
};

/// What the particles hold at the start, by the run's own unknowns.
Whole held_by_particles(Problem<1> const& problem, LayoutChoice const& layout, int resolution,
                        std::string const& work, std::string const& density) {
  SceneChoice choice{.formulation = "momentum/p-rho2",
                     .work = work,
                     .discretisation = {},
                     .resolution = resolution,
                     .smoothing_ratio = 1.2};
  choice.discretisation.density = density;
  choice.discretisation.layout = layout;
  MovingScene<1> scene(problem, choice);
  std::vector<double> const state = scene.initial_state();
  std::size_t const n = scene.particles().size();
  bool const total = work == "work/total-energy";
  Whole whole{};
  for (std::size_t i = 0; i < n; ++i) {
    double const m = scene.particles().masses()[i];
    double const v = state[n + i];
    whole.mass += m;
    whole.momentum += m * v;
    whole.energy += m * (state[2 * n + i] + (total ? 0.0 : 0.5 * v * v));
    if (density == "continuity" && layout.id != "equal-mass") {
      // Its density is its mass over its own cell, so that no volume is missing.
      double const cell = place(problem, layout, resolution).volumes[i];
      BOOST_TEST(std::abs(state[3 * n + i] * cell - m) < 1e-13 * m);
    }
  }
  return whole;
}

/// What two uniform gases of gamma 1.4 hold that meet at a place between 0 and 1.
Whole held_by(std::vector<double> const& left, std::vector<double> const& right, double interface) {
  auto const one = [](std::vector<double> const& state, double length) {
    auto const [rho, u, P] = std::array{state[0], state[1], state[2]};
    return Whole{rho * length, rho * u * length, (P / 0.4 + 0.5 * rho * u * u) * length};
  };
  Whole const a = one(left, interface);
  Whole const b = one(right, 1.0 - interface);
  return {a.mass + b.mass, a.momentum + b.momentum, a.energy + b.energy};
}

// A ladder of odd and even N must not jump: a particle on the interface belongs to neither gas.
BOOST_AUTO_TEST_CASE(particles_hold_the_mass_momentum_and_energy_of_the_exact_initial_state) {
  using List = std::vector<double>;
  for (auto const& [left, right, interface] :
       {std::tuple<List, List, double>{{1.0, 0.0, 1.0}, {0.125, 0.0, 0.1}, 0.5},
        {{1.0, 0.75, 1.0}, {0.125, -0.3, 0.1}, 0.437},
        {{1.0, -0.2, 0.4}, {1.0, 0.2, 0.4}, 0.5}}) {
    Whole const exact = held_by(left, right, interface);
    // So short that the tube needs no more gas than from 0 to 1.
    auto const problem = problem_of<1>(
        "hydro/riemann", {{"left", left}, {"right", right}, {"interface", interface}, {"final_time", 0.01}});
    BOOST_TEST_REQUIRE(problem.domain.extent()[0] == 1.0);
    for (LayoutChoice const& layout : on_a_line) {
      for (int N = 20; N <= 41; ++N) {
        for (auto const& [work, density] :
             {std::pair{"work/internal-energy", "continuity"}, std::pair{"work/total-energy", "summation"}}) {
          Whole const found = held_by_particles(problem, layout, N, work, density);
          BOOST_TEST_CONTEXT(layout.id << ", N = " << N << ", interface " << interface << ", " << work) {
            BOOST_TEST(std::abs(found.mass - exact.mass) < 1e-12);
            BOOST_TEST(std::abs(found.momentum - exact.momentum) < 1e-12);
            BOOST_TEST(std::abs(found.energy - exact.energy) < 1e-12 * exact.energy);
          }
        }
      }
    }
  }
}

template <int Dim>
double mass_of(Problem<Dim> const& problem, LayoutChoice const& choice, int resolution) {
  Layout<Dim> const layout = place(problem, choice, resolution);
  auto const& rho = problem.scalars.at(Field::density);
  std::vector<double> masses(layout.volumes.size());
  for (std::size_t i = 0; i < masses.size(); ++i)
    masses[i] = rho(layout.positions[i], 0.0) * layout.volumes[i];
  for (CutCell<Dim> const& cell : cut_cells(problem, layout, choice))
    masses[cell.particle] = held(cell, problem).density * cell.volume;
  return std::accumulate(masses.begin(), masses.end(), 0.0);
}

BOOST_AUTO_TEST_CASE(cells_of_more_dimensions_hold_all_mass_on_both_sides_of_a_jump) {
  double const contrast = 50.0;
  auto const check = [&](auto const& problem, LayoutChoice const& layout, int resolution) {
    double const exact = 0.5 * (contrast + 1.0);
    BOOST_TEST(std::abs(mass_of(problem, layout, resolution) - exact) < 1e-12 * exact,
               layout.id << ", N = " << resolution);
  };
  auto const square = problem_of<2>("extreme/density-contrast", {{"dimension", 2.0}, {"contrast", contrast}});
  for (int N = 6; N <= 13; ++N) {
    for (LayoutChoice const& layout : {LayoutChoice{"lattice"},
                                       {"jittered", 0.45, 3},
                                       {"clumped", 0.1},
                                       {"touching", 0.01},
                                       {"hexagonal"},
                                       {"glass", 0.0, 1},
                                       {"random", 0.0, 1}})
      check(square, layout, N);
  }
  auto const cube = problem_of<3>("extreme/density-contrast", {{"dimension", 3.0}, {"contrast", contrast}});
  for (int N = 4; N <= 9; ++N) {
    for (LayoutChoice const& layout :
         {LayoutChoice{"lattice"}, {"jittered", 0.45, 3}, {"close-packed"}, {"glass", 0.0, 1}})
      check(cube, layout, N);
  }
}

BOOST_AUTO_TEST_CASE(only_cells_that_a_jump_cuts_are_integrated) {
  auto const tube = problem_of<1>("hydro/riemann", {});
  auto const cut = [&](LayoutChoice const& choice, int N) {
    return cut_cells(tube, place(tube, choice, N), choice);
  };
  for (int const N : {20, 24, 50, 100, 1000, 12800}) BOOST_TEST(cut({"lattice"}, N).empty());
  for (int const N : {21, 25, 101, 12801}) {
    auto const cells = cut({"lattice"}, N);
    BOOST_TEST_REQUIRE(cells.size() == 1u);
    BOOST_TEST(cells.front().particle == static_cast<std::size_t>(N / 2));
    BOOST_TEST(std::abs(held(cells.front(), tube).density - 0.5625) < 1e-12);
  }
  auto const smooth = problem_of<1>("hydro/acoustic", {});
  BOOST_TEST(cut_cells(smooth, place(smooth, {"lattice"}, 25), {"lattice"}).empty());
}

// Gases that run into each other in one cell: what they lose of motion is heat, however cold they are.
BOOST_AUTO_TEST_CASE(the_energy_of_two_streams_in_one_cell_becomes_heat) {
  auto const problem = problem_of<1>("hydro/riemann", {{"left", std::vector<double>{1.0, 3.0, 1e-9}},
                                                       {"right", std::vector<double>{1.0, -3.0, 1e-9}},
                                                       {"final_time", 1e-3}});
  auto const cells = cut_cells(problem, place(problem, {"lattice"}, 21), {"lattice"});
  BOOST_TEST_REQUIRE(cells.size() == 1u);
  CellState<1> const state = held(cells.front(), problem);
  BOOST_TEST(std::abs(state.velocity[0]) < 1e-13);
  BOOST_TEST(std::abs(state.internal_energy - 4.5) < 1e-8);
}

BOOST_AUTO_TEST_CASE(a_cell_of_two_materials_conducts_as_both_in_series) {
  auto const problem = problem_of<1>("extreme/conductivity-contrast", {{"contrast", 9.0}});
  SceneChoice choice{
      .formulation = "conduction/brookshaw", .discretisation = {}, .resolution = 21, .smoothing_ratio = 1.2};
  Scene<1> const scene(problem, choice);
  auto const& K = scene.particles().scalar(Field::conductivity);
  BOOST_TEST(K[9] == 1.0);
  BOOST_TEST(std::abs(K[10] - 2.0 / (1.0 + 1.0 / 9.0)) < 1e-14);
  BOOST_TEST(K[11] == 9.0);
}

BOOST_AUTO_TEST_SUITE_END()
