// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/run/measure_moving.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/measure/shock.hpp"
#include "harness/run/exact_fields.hpp"
#include "harness/scene/wall_geometry.hpp"

namespace sphverify {

namespace {
constexpr std::size_t longest_history = 256;
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
}

template <int Dim>
void measure_wall_flux(Problem<Dim> const& problem, MovingScene<Dim> const& scene, RunRecord& record) {
  if (!problem.vectors.contains(Field::flux) || !scene.wall_terms_are_exchange()) return;
  auto const& exact = problem.vectors.at(Field::flux);
  double const t = problem.final_time;
  Particles<Dim> const& particles = scene.particles();
  double scale = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    Vector<Dim> const flux = exact(particles.positions()[i], t);
    for (Wall<Dim> const& wall : scene.walls())
      scale = larger(scale, std::abs(flux.dot(wall.outward_normal)));
  }
  auto const exchange = scene.wall_exchange();
  auto const volumes = exact_volumes(problem, particles, t);
  for (std::size_t w = 0; w < exchange.size(); ++w) {
    Wall<Dim> const& wall = scene.walls()[w];
    Number const inward = exact_wall_flux(exact, wall, particles, volumes, t);
    if (!inward) continue;
    double const measured = exchange[w].heat / wall_area(problem.domain, wall);
    record.wall_flux.push_back({measured, *inward, measured - *inward, scale});
  }
}

template <int Dim>
void measure_shocks(Problem<Dim> const& problem, MovingScene<Dim> const& scene, RunRecord& record, Motion& motion) {
  Particles<Dim> const& particles = scene.particles();
  for (ShockFront const& front : problem.shocks(problem.final_time)) {
    record.shocks.push_back(measure_shock(particles, front));
  }
  auto const& exact = problem.scalars.at(Field::internal_energy);
  for (Wall<Dim> const& wall : scene.walls()) {
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      if (wall.distance(particles.positions()[i]) < wall.distance(particles.positions()[nearest]))
        nearest = i;
    }
    double const e = exact(particles.positions()[nearest], problem.final_time);
    if (e <= 0.0) continue;
    double const excess = particles.scalar(Field::internal_energy)[nearest] / e - 1.0;
    double const most = std::abs(motion.wall_heating.value_or(0.0));
    if (!motion.wall_heating || larger(std::abs(excess), most) != most) motion.wall_heating = excess;
  }
}

template <int Dim>
void measure_budgets(Problem<Dim> const& problem, SceneChoice const& choice, MovingScene<Dim> const& scene,
                     GasBudgets<Dim> const& budgets, RunRecord& record) {
  MovingScene<Dim> start(problem, choice);
  start.evaluate(0.0, start.initial_state().data());
  bool const with_walls = !scene.geometry().contacts.empty() || problem.walls.empty();

  Budget energy;
  energy.initial = start.energy();
  energy.final = scene.energy();
  energy.exchanged = budgets.exchanged_energy();
  energy.drift = energy.final - energy.initial - energy.exchanged;
  energy.pair_drift = budgets.pair_energy;
  bool const is_known = scene.heat_exchange_is_known();
  if (!is_known) {
    energy.exchanged = energy.drift = not_known;
    energy.pair_drift.reset();
  }
  Vector<Dim> impulse_defect = Vector<Dim>::Zero();
  double energy_defect = 0.0;
  for (std::size_t w = 0; w < budgets.walls.size(); ++w) {
    WallExchange<Dim> const& wall = budgets.walls[w];
    impulse_defect += wall.force - wall.prescribed_force;
    energy_defect += wall.power - wall.prescribed_power;
    Vector<Dim> const& place = scene.walls()[w].point;
    record.wall_budgets.push_back({{place.begin(), place.end()},
                                    {wall.force.begin(), wall.force.end()},
                                    {wall.prescribed_force.begin(), wall.prescribed_force.end()},
                                    is_known ? wall.power : not_known,
                                    is_known ? wall.prescribed_power : not_known,
                                    is_known ? wall.heat : not_known});
  }
  if (with_walls && is_known && scene.wall_terms_are_exchange()) energy.wall_budget_defect = energy_defect;
  record.conservation["energy"] = energy;

  for (int k = 0; k < Dim; ++k) {
    Budget momentum;
    momentum.initial = start.momentum()[k];
    momentum.final = scene.momentum()[k];
    momentum.exchanged = budgets.exchanged_impulse()[k];
    momentum.drift = momentum.final - momentum.initial - momentum.exchanged;
    momentum.pair_drift = budgets.pair_impulse[k];
    if (with_walls) momentum.wall_budget_defect = impulse_defect[k];
    record.momentum.push_back(momentum);
  }
  Budget mass;  // particles carry theirs along
  for (double const m : scene.particles().masses()) mass.final += m;
  mass.initial = mass.final;
  record.conservation["mass"] = mass;
}

History thinned(History const& history) {
  History stored;
  std::size_t const n = history.time.size();
  std::size_t const stride = std::max<std::size_t>(1, (n + longest_history - 1) / longest_history);
  auto const thin = [&](std::vector<double> const& values) {
    std::vector<double> kept;
    for (std::size_t k = 0; k < n; ++k) {
      if (k % stride == 0 || k + 1 == n) kept.push_back(values[k]);
    }
    return kept;
  };
  stored = {
      thin(history.time), thin(history.energy), thin(history.exchanged), thin(history.momentum), {}, {}};
  for (auto const& wall : history.wall_impulse_defect) stored.wall_impulse_defect.push_back(thin(wall));
  for (auto const& wall : history.wall_energy_defect) stored.wall_energy_defect.push_back(thin(wall));
  return stored;
}

#define SPHVERIFY_INSTANTIATE(D)                                                                              \
  template void measure_wall_flux(Problem<D> const&, MovingScene<D> const&, RunRecord&);                      \
  template void measure_shocks(Problem<D> const&, MovingScene<D> const&, RunRecord&, Motion&);                \
  template void measure_budgets(Problem<D> const&, SceneChoice const&, MovingScene<D> const&,                 \
                                GasBudgets<D> const&, RunRecord&);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
