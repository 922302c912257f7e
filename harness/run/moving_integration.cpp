// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/run/moving_integration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "formulations/basics/parallel.hpp"
#include "reports/extremes.hpp"

namespace sphverify {

namespace {

/// A gas that moves, or has heated, this many times faster or hotter than the problem ever does, is lost.
constexpr double unstable_speed = 100.0;
constexpr double unstable_energy = 1e4;

/// A step that collapses is most often about to let particles collide: says which.
template <int Dim>
std::string collision(FinalState<Dim> const& state) {
  std::string const who = state.gas->scene().closest_approach();
  return who.empty() ? "" : "; closest to colliding: " + who;
}

/// Masses apart by no more than this part run as well with continuity as with other densities.
constexpr double harmless_mass_ratio = 4.0;

/// What a run that broke with unequal masses and continuity density most likely broke by, and what to do instead; empty elsewhere.
template <int Dim>
std::string unequal_masses(MovingScene<Dim> const& scene, std::string const& density) {
  if (density != "continuity") return "";
  auto const [lightest, heaviest] = std::ranges::minmax(scene.particles().masses());
  if (!(heaviest > harmless_mass_ratio * lightest)) return "";
  return fmt::format(
      "; masses differ by a factor of {:.3g}, and by the continuity equation a light particle loses density in proportion to the mass of a "
      "heavy neighbour that it parts from, more than it has: take normalised or summed density with adaptive smoothing, or equal masses",
      heaviest / lightest);
}

/// What a run's monitor looks for.
struct Seen {
  double lowest_density = std::numeric_limits<double>::infinity();
  double lowest_pressure = std::numeric_limits<double>::infinity();
  std::optional<std::size_t> lost;  ///< the first particle whose velocity or energy is out of all bounds
};

template <int Dim>
void keep_history(double t, double const* y, MovingScene<Dim> const& scene, GasBudgets<Dim> const& budgets,
                  History& history) {
  history.time.push_back(t);
  history.energy.push_back(scene.energy(y));
  history.momentum.push_back(scene.momentum(y)[0]);
  bool const is_known = scene.heat_exchange_is_known();
  history.exchanged.push_back(is_known ? budgets.exchanged_energy() : std::numeric_limits<double>::quiet_NaN());
  history.wall_impulse_defect.resize(budgets.walls.size());
  history.wall_energy_defect.resize(budgets.walls.size());
  for (std::size_t w = 0; w < budgets.walls.size(); ++w) {
    WallExchange<Dim> const& wall = budgets.walls[w];
    history.wall_impulse_defect[w].push_back(wall.force[0] - wall.prescribed_force[0]);
    history.wall_energy_defect[w].push_back(is_known ? wall.power - wall.prescribed_power : std::numeric_limits<double>::quiet_NaN());
  }
}

}  // namespace

template <int Dim>
Motion motion_of(FinalState<Dim> const& state) {
  Motion motion;
  motion.steps_bound_by = state.gas->steps_bound_by();
  if (state.gas->largest_step() > 0.0) {
    motion.smallest_step = state.gas->smallest_step();
    motion.largest_step = state.gas->largest_step();
  }
  if (std::isfinite(state.lowest_density)) motion.lowest_density = state.lowest_density;
  if (std::isfinite(state.lowest_pressure)) motion.lowest_pressure = state.lowest_pressure;
  return motion;
}

template <int Dim>
std::nullopt_t MovingIntegration<Dim>::give_up(FinalState<Dim> const& state, std::string const& status,
                                               std::string const& reason) {
  record_.status = status;
  record_.reason = reason;
  if (status != "timed-out") record_.reason += unequal_masses(state.gas->scene(), record_.discretisation.density);
  record_.scene = state.gas->scene().record();
  record_.motion = motion_of(state);
  return std::nullopt;
}

template <int Dim>
std::optional<FinalState<Dim>> MovingIntegration<Dim>::integrate(SceneChoice const& choice, double rung) {
  FinalState<Dim> state;
  Clock const clock;
  state.gas = std::make_unique<MovingGas<Dim>>(problem_, choice, is_leapfrog() ? rung : 1.0);
  double const setup = clock.seconds();
  MovingScene<Dim>& scene = state.gas->scene();
  double speed = 0.0, energy = 0.0;
  {
    std::vector<double> const scales = scene.scales();
    speed = scales[scene.coordinates()];
    energy = scales[2 * scene.coordinates()];
  }
  std::string status = "unstable";
  auto const monitor = [&](double t, double const* y, GasBudgets<Dim> const& budgets) -> std::string {
    if (options_.interrupted && *options_.interrupted) throw Interrupted();
    if (options_.time_budget > 0.0 && spent() > options_.time_budget) {
      status = "timed-out";
      return fmt::format("time budget of {:g} s spent at t = {:.6g}", options_.time_budget, t);
    }
    auto const& particles = scene.particles();
    auto const& rho = particles.scalar(Field::density);
    auto const& P = particles.scalar(Field::pressure);
    auto const& v = particles.vector(Field::velocity);
    auto const& e = particles.scalar(Field::internal_energy);
    Seen const seen = joined_blocks(
        particles.size(), scene.threads(), Seen{},
        [&](std::size_t begin, std::size_t end) {
          Seen part;
          for (std::size_t i = begin; i < end && !part.lost; ++i) {
            part.lowest_density = smaller(part.lowest_density, rho[i]);
            part.lowest_pressure = smaller(part.lowest_pressure, P[i]);
            bool const is_usual = v[i].norm() <= unstable_speed * speed && !(std::abs(e[i]) > unstable_energy * energy);
            if (!is_usual) part.lost = i;
          }
          return part;
        },
        [](Seen& all, Seen const& part) {
          if (all.lost) return;
          all.lowest_density = smaller(all.lowest_density, part.lowest_density);
          all.lowest_pressure = smaller(all.lowest_pressure, part.lowest_pressure);
          all.lost = part.lost;
        });
    state.lowest_density = smaller(state.lowest_density, seen.lowest_density);
    state.lowest_pressure = smaller(state.lowest_pressure, seen.lowest_pressure);
    if (seen.lost) {
      std::size_t const i = *seen.lost;
      double const fast = v[i].norm();
      if (!std::isfinite(fast)) {
        status = "non-finite";
        return fmt::format("velocity of particle {} is not finite at t = {:.6g}", i, t);
      }
      if (fast > unstable_speed * speed) {
        return fmt::format("particle {} moves at {:.3g}, {:g} times the problem's {:.3g}, at t = {:.6g}", i, fast,
                           unstable_speed, speed, t);
      }
      return fmt::format("particle {} has internal energy {:.3g}, {:g} times the problem's {:.3g}, at t = {:.6g}", i,
                         std::abs(e[i]), unstable_energy, energy, t);
    }
    if (options_.measure.contains(Measure::history)) keep_history(t, y, scene, budgets, state.history);
    return "";
  };
  OdeResult result;
  try {
    result = state.gas->integrate(method(), {rung, rung}, monitor);
  } catch (BrokenRun const& broken) {
    return give_up(state, broken.status(), broken.what());
  }
  std::string const when = fmt::format(" at t = {:.6g}", result.time);
  if (result.outcome == OdeOutcome::out_of_steps) return give_up(state, "timed-out", result.reason + when);
  if (result.outcome == OdeOutcome::not_finite)
    return give_up(state, "non-finite", result.reason + when + collision(state));
  if (result.outcome == OdeOutcome::failed) {
    return give_up(state, "unstable", result.reason + when + collision(state));
  }
  if (result.outcome == OdeOutcome::stopped) return give_up(state, status, result.reason);
  state.steps = result.steps;
  state.budgets = state.gas->budgets(result.quadratures.data());
  state.cost.seconds = clock.seconds();
  state.cost.cpu_seconds = options_.threads == 1 ? Number(clock.cpu_seconds()) : std::nullopt;
  state.cost.setup_seconds = setup;
  state.cost.steps = result.steps;
  state.cost.rate_evaluations = scene.work().evaluations;
  state.cost.pair_interactions = scene.work().pair_interactions;
  state.cost.peak_bytes = scene.bytes(is_leapfrog()) + result.bytes;
  return state;
}

#define SPHVERIFY_INSTANTIATE(Dim)                   \
  template Motion motion_of(FinalState<Dim> const&); \
  template class MovingIntegration<Dim>;
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
