// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/run/conduction_integration.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace sphverify {

namespace {

/// A solution that has grown to this many times the temperatures of the problem is lost.
constexpr double unstable_growth = 100.0;

}  // namespace

template <int Dim>
double temperature_scale(Problem<Dim> const& problem) {
  auto const& exact = problem.scalars.at(Field::temperature);
  VectorField<Dim> const samples = lattice(problem.domain, Dim == 1 ? 256 : 32).positions;
  double largest = 0.0;
  auto const include = [&](double temperature) {
    if (std::isfinite(temperature)) largest = std::max(largest, std::abs(temperature));
  };
  for (double const t : {0.0, problem.final_time}) {
    for (std::size_t i = 0; i < samples.size(); ++i) include(exact(samples[i], t));
    for (Wall<Dim> const& wall : problem.walls) {
      if (wall.temperature) include(wall.temperature(wall.point, t));
    }
  }
  return largest > 0.0 ? largest : 1.0;
}

template <int Dim>
double energy_of(Particles<Dim> const& particles, double const* temperature) {
  double sum = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) sum += particles.masses()[i] * temperature[i];
  return sum;
}

template <int Dim>
std::optional<OdeResult> ConductionIntegration<Dim>::integrate(FrozenConduction<Dim>& conduction, double tolerance,
                                                               bool with_quadratures) {
  history_ = History{};
  Particles<Dim> const& particles = conduction.scene().particles();
  std::size_t const givers = problem_.walls.size() + 1;
  std::string status;
  auto const monitor = [&](double t, double const* T, double const*) -> std::string {
    if (options_.interrupted && *options_.interrupted) throw Interrupted();
    double largest = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      if (!std::isfinite(T[i])) {
        status = "non-finite";
        return fmt::format("temperature of particle {} is not finite at t = {:.6g}", i, t);
      }
      largest = std::max(largest, std::abs(T[i]));
    }
    if (largest > unstable_growth * scale_) {
      status = "unstable";
      return fmt::format("temperature grew to {:.3g}, {:g} times the problem's {:.3g}, at t = {:.6g}",
                         largest, unstable_growth, scale_, t);
    }
    if (options_.time_budget > 0.0 && spent() > options_.time_budget) {
      status = "timed-out";
      return fmt::format("time budget of {:g} s spent at t = {:.6g}", options_.time_budget, t);
    }
    return "";
  };
  bool const with_history = with_quadratures && options_.measure.contains(Measure::history);
  auto const sample = [&](double t, double const* T, double const* q) {
    if (watch_) watch_->observe(t, T);
    if (!with_history) return;
    history_.time.push_back(t);
    history_.energy.push_back(energy_of(particles, T));
    bool const is_known = conduction.scene().exchange_is_known();
    history_.exchanged.push_back(is_known ? std::accumulate(q, q + givers, 0.0) : std::numeric_limits<double>::quiet_NaN());
  };
  typename FrozenConduction<Dim>::Sample const looks =
      watch_ || with_history ? sample : typename FrozenConduction<Dim>::Sample{};
  OdeResult result =
      conduction.integrate(record_.discretisation.integrator, problem_.final_time,
                           {tolerance, tolerance * scale_}, with_quadratures, monitor, looks);
  if (result.outcome == OdeOutcome::finished) return result;
  record_.reason = result.reason;
  if (result.outcome == OdeOutcome::stopped) {
    record_.status = status;
  } else {
    record_.status = result.outcome == OdeOutcome::not_finite ? "non-finite" : "unstable";
    record_.reason += fmt::format(" at t = {:.6g}", result.time);
  }
  return std::nullopt;
}

#define SPHVERIFY_INSTANTIATE(Dim)                                 \
  template double temperature_scale(Problem<Dim> const&);          \
  template double energy_of(Particles<Dim> const&, double const*); \
  template class ConductionIntegration<Dim>;
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
