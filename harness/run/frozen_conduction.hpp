// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "harness/integrate/coloured_jacobian.hpp"
#include "harness/integrate/ode.hpp"
#include "harness/scene/scene.hpp"

namespace sphverify {

/// Heat conduction on a scene's particles as an ordinary differential equation for their temperatures
/// (specific heat 1): dT/dt = scheme + source. Its quadratures are the energies that the walls and the source
/// give, in the order walls, source, pairs, prescribed walls.
template <int Dim>
class FrozenConduction {
 public:
  /// @param temperature_scale size of a typical temperature
  FrozenConduction(Problem<Dim> problem, SceneChoice const& choice, double temperature_scale);

  Scene<Dim>& scene() { return scene_; }

  std::vector<double> initial_temperature() const;

  using Sample = decltype(OdeSystem::sample);

  /// Integrates to a time by the named method (bdf, implicit-runge-kutta, runge-kutta,
  /// runge-kutta-chebyshev).
  /// @param with_quadratures whether to integrate what crosses walls, at the price of one more rate a step
  /// @param sample called at `sample_times`, if there is one
  OdeResult integrate(std::string const& method, double final_time, Tolerances tolerances,
                      bool with_quadratures, decltype(OdeSystem::monitor) monitor, Sample sample = {});

  /// The linearised rate at a state.
  ColouredJacobian& jacobian();

  /// Brings all the scene's fields to a state.
  void evaluate(double time, double const* temperature);

  std::size_t bytes() const { return scene_.bytes() + (jacobian_ ? jacobian_->bytes() : 0); }

 private:
  OdeResult integrate_from(std::vector<double> initial, std::string const& method, double final_time,
                           Tolerances tolerances, bool with_quadratures, decltype(OdeSystem::monitor) monitor,
                           Sample sample);
  void rate(double time, double const* temperature, double* out);
  void quadrature(double time, double const* temperature, double* out);

  Scene<Dim> scene_;
  double temperature_scale_;
  std::unique_ptr<ColouredJacobian> jacobian_;
};

extern template class FrozenConduction<1>;
extern template class FrozenConduction<2>;
extern template class FrozenConduction<3>;

}  // namespace sphverify
