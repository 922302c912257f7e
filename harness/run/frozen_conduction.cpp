// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/run/frozen_conduction.hpp"

#include <fmt/format.h>

#include <cmath>

#include "formulations/basics/finite.hpp"
#include "harness/integrate/dependencies.hpp"
#include "harness/measure/sample_times.hpp"

namespace sphverify {

template <int Dim>
FrozenConduction<Dim>::FrozenConduction(Problem<Dim> problem, SceneChoice const& choice,
                                        double temperature_scale)
    : scene_(std::move(problem), choice), temperature_scale_(temperature_scale) {
  if (!scene_.problem().conductivity_depends_on_temperature) scene_.freeze();
}

template <int Dim>
void FrozenConduction<Dim>::evaluate(double time, double const* temperature) {
  scene_.set_temperature(temperature);
  scene_.evaluate(time);
}

template <int Dim>
void FrozenConduction<Dim>::rate(double time, double const* temperature, double* out) {
  evaluate(time, temperature);
  scene_.heating(time, out);
}

template <int Dim>
void FrozenConduction<Dim>::quadrature(double time, double const* temperature, double* out) {
  evaluate(time, temperature);
  double pairs = scene_.scheme_power();
  std::vector<Number> const prescribed = scene_.prescribed_wall_power(time);
  for (double const power : scene_.exchanged_power(prescribed)) {
    *out++ = power;
    pairs -= power;
  }
  *out++ = scene_.source_power(time);
  *out++ = pairs;
  for (Number const& power : prescribed) *out++ = power.value_or(0.0);
}

template <int Dim>
ColouredJacobian& FrozenConduction<Dim>::jacobian() {
  if (!jacobian_) {
    jacobian_ = std::make_unique<ColouredJacobian>(
        dependencies(scene_.geometry(), supports_seen(scene_.scheme())),
        [this](double t, double const* T, double* out) { rate(t, T, out); },
        scene_.problem().conducts_linearly(), temperature_scale_);
  }
  return *jacobian_;
}

template <int Dim>
std::vector<double> FrozenConduction<Dim>::initial_temperature() const {
  std::vector<double> initial;
  auto const& exact = scene_.problem().scalars.at(Field::temperature);
  for (std::size_t i = 0; i < scene_.particles().size(); ++i)
    initial.push_back(exact(scene_.particles().positions()[i], 0.0));
  return initial;
}

template <int Dim>
OdeResult FrozenConduction<Dim>::integrate(std::string const& method, double final_time,
                                           Tolerances tolerances, bool with_quadratures,
                                           decltype(OdeSystem::monitor) monitor, Sample sample) {
  OdeResult result;
  std::vector<double> initial = initial_temperature();
  result.reason = why_not_finite("initial temperature", {initial});
  if (!result.reason.empty()) {
    result.outcome = OdeOutcome::not_finite;
    return result;
  }
  result = integrate_from(std::move(initial), method, final_time, tolerances, with_quadratures,
                          std::move(monitor), std::move(sample));
  if (result.outcome == OdeOutcome::not_finite) {
    std::size_t const n = scene_.particles().size();
    result.reason = result.not_finite < n ? fmt::format("heating of particle {}", result.not_finite)
                                          : "what walls and sources exchange";
    result.reason += " is not finite";
  }
  return result;
}

template <int Dim>
OdeResult FrozenConduction<Dim>::integrate_from(std::vector<double> initial, std::string const& method,
                                                double final_time, Tolerances tolerances,
                                                bool with_quadratures, decltype(OdeSystem::monitor) monitor,
                                                Sample sample) {
  OdeSystem system;
  system.size = scene_.particles().size();
  system.threads = scene_.threads();
  system.rate = [this](double t, double const* T, double* out) { rate(t, T, out); };
  system.monitor = std::move(monitor);
  if (sample) {
    system.sample = std::move(sample);
    system.sample_times = sample_times(final_time);
  }
  if (with_quadratures) {
    system.quadratures = scene_.problem().walls.size() + 2 + scene_.geometry().contacts.size();
    system.quadrature = [this](double t, double const* T, double* out) { quadrature(t, T, out); };
  }
  if (method == "runge-kutta")
    return integrate_runge_kutta(system, std::move(initial), final_time, tolerances);
  if (method == "runge-kutta-chebyshev")
    return integrate_chebyshev(system, std::move(initial), final_time, tolerances);
  // Beyond one dimension a factorisation fills in, and costs more than it saves.
  if constexpr (Dim == 1) system.jacobian = &jacobian();
  if (method == "implicit-runge-kutta") {
    // Of order 3: the error per run falls with the cube of the step.
    auto const steps = static_cast<std::uint64_t>(std::ceil(1.0 / std::cbrt(tolerances.relative)));
    return integrate_implicit_runge_kutta(system, std::move(initial), final_time, steps,
                                          {1e-3 * tolerances.relative, 1e-3 * tolerances.absolute});
  }
  return integrate_bdf(system, std::move(initial), final_time, tolerances);
}

template class FrozenConduction<1>;
template class FrozenConduction<2>;
template class FrozenConduction<3>;

}  // namespace sphverify
