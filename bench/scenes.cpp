// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "bench/benchmarks.hpp"
#include "bench/passes.hpp"
#include "cases/hydro/uniform.hpp"
#include "harness/scene/moving_scene.hpp"

namespace sphverify::bench {

namespace {

/// What a scene may go without.
struct Needs {
  bool walls = true, viscosity = true, conduction = true;
  bool moves = true;      ///< else heat conduction on particles that stand still
  bool new_list = false;  ///< particles have outrun their list at every evaluation
};

/// A cube of conducting gas at rest between insulated walls, or periodic.
Problem<3> make_problem(Needs const& needs) {
  Parameters parameters(UniformGas::info().parameters);
  parameters.set("dimension", 3.0);
  parameters.set("boundary", std::string(needs.walls ? "velocity" : "periodic"));
  auto problem = std::get<Problem<3>>(UniformGas::problem(parameters));
  if (!needs.conduction) return problem;
  problem.conductivity = [](Vector<3> const&, double) { return 1.0; };
  for (Wall<3>& wall : problem.walls) {
    wall.flux = [](Vector<3> const&, double) { return Vector<3>(Vector<3>::Zero()); };
  }
  return problem;
}

SceneChoice make_choice(Needs const& needs, std::size_t side) {
  std::string const conduction = needs.conduction ? "conduction/brookshaw" : "";
  SceneChoice choice{.formulation = needs.moves ? "momentum/p-rho2" : conduction,
                     .work = needs.moves ? "work/internal-energy" : "",
                     .conduction = needs.moves ? conduction : "",
                     .walls = needs.walls,
                     .discretisation = {},
                     .resolution = static_cast<int>(side),
                     .smoothing_ratio = 1.2};
  choice.discretisation.density = needs.moves ? "continuity" : "given";
  choice.discretisation.closure = "one-sided";
  if (needs.moves && needs.viscosity) choice.discretisation.viscosity = {1.0, 2.0};
  return choice;
}

/// Adds to the counters what one evaluation visits, and how long it takes a particle.
void count(benchmark::State& state, WorkCount const& work, std::size_t particles, std::size_t bytes) {
  auto const per_evaluation = [&](std::uint64_t visited) {
    return static_cast<double>(visited) / static_cast<double>(work.evaluations * particles);
  };
  double const ns = state.counters["ns_per_pair"] * state.counters["pairs_per_particle"];
  state.counters["ns_per_particle"] = ns;
  state.counters["pairs_visited"] = per_evaluation(work.pair_interactions);
  state.counters["contacts_visited"] = per_evaluation(work.wall_interactions);
  state.counters["bytes_per_particle"] = static_cast<double>(bytes) / static_cast<double>(particles);
}

void measure_moving(benchmark::State& state, Needs const& needs, std::size_t side) {
  MovingScene<3> scene(make_problem(needs), make_choice(needs, side));
  std::vector<double> const here = scene.initial_state();
  std::vector<double> there = here;
  // To and fro, and not into a wall: slowly, or too far for a list to be kept.
  double const movement = (needs.new_list ? 0.15 : 0.01) * scene.particles().smoothing_length();
  constexpr int evaluations = 10;
  int const turn = needs.new_list ? 1 : evaluations / 2;
  std::size_t const coordinates = 3 * scene.particles().size();
  scene.evaluate(0.0, here.data());
  time_passes(state, scene.particles().size(), scene.geometry().neighbours.pairs(), [&] {
    for (int n = 1; n <= evaluations; ++n) {
      int const phase = n % (2 * turn);
      double const shift = movement * std::min(phase, 2 * turn - phase) / std::sqrt(3.0);
      for (std::size_t i = 0; i < coordinates; ++i) there[i] = here[i] + shift;
      scene.evaluate(0.0, there.data());
    }
  });
  for (char const* counter : {"ns_per_pair", "wall_ns_per_pair"})
    state.counters[counter].value /= evaluations;
  count(state, scene.work(), scene.particles().size(), scene.bytes());
}

void measure_at_rest(benchmark::State& state, Needs const& needs, std::size_t side) {
  Scene<3> scene(make_problem(needs), make_choice(needs, side));
  scene.freeze();
  std::vector<double> rates(scene.particles().size());
  time_passes(state, rates.size(), scene.geometry().neighbours.pairs(), [&] {
    scene.evaluate(0.0);
    scene.heating(0.0, rates.data());
  });
  count(state, scene.work(), rates.size(), scene.bytes());
}

void measure(std::string const& name, Needs const& needs, std::size_t side) {
  benchmark::RegisterBenchmark(("scene/" + name + "/" + std::to_string(side)).c_str(),
                               [=](benchmark::State& state) {
                                 needs.moves ? measure_moving(state, needs, side)
                                             : measure_at_rest(state, needs, side);
                               })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_scenes(std::span<std::size_t const> sides) {
  for (std::size_t const side : sides) {
    measure("full", {}, side);
    measure("full-new-list", {.new_list = true}, side);
    measure("without-walls", {.walls = false}, side);
    measure("without-viscosity", {.viscosity = false}, side);
    measure("without-conduction", {.conduction = false}, side);
    measure("without-motion", {.moves = false}, side);
    measure("pressure-alone", {.walls = false, .viscosity = false, .conduction = false}, side);
  }
}

}  // namespace sphverify::bench
