// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/run/moving_gas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sphverify {

namespace {

constexpr std::uint64_t most_steps = 2'000'000;
/// A step that is this part of the run would never end it.
constexpr double collapsed = 1e-9;
/// Nor does a smooth flow need steps that are on average this part of what its limits allow.
constexpr double unresolved = 1e-3;

/// Writes and reads the parts of a budget in one order.
template <int Dim>
double* put(Vector<Dim> const& v, double* out) {
  return std::copy(v.begin(), v.end(), out);
}
template <int Dim>
double const* take(double const* from, Vector<Dim>& v) {
  std::copy(from, from + Dim, v.begin());
  return from + Dim;
}

}  // namespace

template <int Dim>
Vector<Dim> GasBudgets<Dim>::exchanged_impulse() const {
  Vector<Dim> sum = source_impulse;
  for (auto const& wall : walls) sum += wall.force;
  return sum;
}

template <int Dim>
double GasBudgets<Dim>::exchanged_energy() const {
  double sum = source_energy;
  for (auto const& wall : walls) sum += wall.power;
  return sum;
}

template <int Dim>
MovingGas<Dim>::MovingGas(Problem<Dim> problem, SceneChoice const& choice, double courant_factor)
    : scene_(std::move(problem), choice), courant_factor_(courant_factor) {}

/// Impulses first: two per wall, the source's and the pairs'.
template <int Dim>
std::size_t MovingGas<Dim>::impulses() const {
  return Dim * (2 * scene_.walls().size() + 2);
}

template <int Dim>
std::size_t MovingGas<Dim>::quadratures() const {
  return impulses() + 3 * scene_.walls().size() + 2;
}

template <int Dim>
void MovingGas<Dim>::quadrature(double* out) const {
  auto const exchange = scene_.wall_exchange();
  Vector<Dim> const source = scene_.source_force();
  Vector<Dim> pairs = scene_.force() - source;
  for (WallExchange<Dim> const& wall : exchange) {
    out = put<Dim>(wall.force, out);
    out = put<Dim>(wall.prescribed_force, out);
    pairs -= wall.force;
  }
  out = put<Dim>(source, out);
  out = put<Dim>(pairs, out);
  double const source_power = scene_.source_power();
  double pair_power = scene_.power() - source_power;
  for (WallExchange<Dim> const& wall : exchange) {
    for (double const value : {wall.power, wall.prescribed_power, wall.heat}) *out++ = value;
    pair_power -= wall.power;
  }
  *out++ = source_power;
  *out = pair_power;
}

template <int Dim>
GasBudgets<Dim> MovingGas<Dim>::budgets(double const* q) const {
  GasBudgets<Dim> all;
  all.walls.resize(scene_.walls().size());
  for (WallExchange<Dim>& wall : all.walls) {
    q = take<Dim>(q, wall.force);
    q = take<Dim>(q, wall.prescribed_force);
  }
  q = take<Dim>(q, all.source_impulse);
  q = take<Dim>(q, all.pair_impulse);
  for (WallExchange<Dim>& wall : all.walls) {
    for (double* value : {&wall.power, &wall.prescribed_power, &wall.heat}) *value = *q++;
  }
  all.source_energy = *q++;
  all.pair_energy = *q;
  return all;
}

template <int Dim>
StepLimit MovingGas<Dim>::tightest_limit() const {
  auto limits = scene_.step_limits();
  // A cold gas at rest has no limit of its own: the run takes a hundred steps at least.
  limits.push_back({"duration", 0.01 * scene_.problem().final_time});
  return *std::min_element(limits.begin(), limits.end(),
                           [](StepLimit const& a, StepLimit const& b) { return a.step < b.step; });
}

template <int Dim>
double MovingGas<Dim>::leapfrog_step() {
  StepLimit const bound = tightest_limit();
  double const step = courant_factor_ * bound.step;
  ++steps_bound_by_[std::string(bound.name)];
  smallest_step_ = smallest_step_ == 0.0 ? step : std::min(smallest_step_, step);
  largest_step_ = std::max(largest_step_, step);
  return step;
}

template <int Dim>
OdeResult MovingGas<Dim>::integrate(std::string const& method, Tolerances tolerances, Monitor const& monitor) {
  double const final_time = scene_.problem().final_time;
  OdeSystem system;
  system.size = scene_.unknowns();
  system.quadratures = quadratures();
  system.rate = [this](double t, double const* y, double* dydt) {
    scene_.evaluate(t, y);
    scene_.rates(dydt);
  };
  // Both integrators ask for it right after the rate at the same state, at which the scene still is.
  system.quadrature = [this](double, double const*, double* dqdt) { quadrature(dqdt); };
  system.monitor = [&](double t, double const* y, double const* q) { return monitor(t, y, budgets(q)); };
  std::vector<double> initial = scene_.initial_state();
  OdeResult result;
  if (method == "leapfrog") {
    result =
        integrate_leapfrog(system, std::move(initial), final_time,
                           {.coordinates = scene_.coordinates(),
                            .impulses = impulses(),
                            .rate =
                                [this](double t, double const* y, double* dydt) {
                                  scene_.evaluate(t, y, dydt);
                                  scene_.rates(dydt);
                                },
                            .drift =
                                [this](double, double const* y, double const* velocities, double* rates) {
                                  scene_.drift(y, velocities);
                                  scene_.drift_rates(rates);
                                },
                            .largest_step = [this](double) { return leapfrog_step(); },
                            .smallest_step = collapsed * final_time,
                            .most_steps = most_steps,
                            .threads = scene_.threads()});
  } else {
    scene_.evaluate(0.0, initial.data());
    system.smallest_step = unresolved * tightest_limit().step;
    system.threads = scene_.threads();
    system.scales = scene_.scales();
    // Budgets add up what the whole gas exchanges; a tolerance in proportion to it does not rule the step.
    system.scales.resize(system.size + system.quadratures, std::numeric_limits<double>::max() * 1e-20);
    result = integrate_runge_kutta(system, std::move(initial), final_time, tolerances);
  }
  if (result.outcome == OdeOutcome::finished) scene_.evaluate(final_time, result.y.data());
  if (result.outcome == OdeOutcome::not_finite)
    result.reason = fmt::format("{} is not finite", scene_.rate_name(result.not_finite));
  return result;
}

template struct GasBudgets<1>;
template struct GasBudgets<2>;
template struct GasBudgets<3>;
template class MovingGas<1>;
template class MovingGas<2>;
template class MovingGas<3>;

}  // namespace sphverify
