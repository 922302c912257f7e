// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>

#include "harness/integrate/ode.hpp"
#include "harness/scene/moving_scene.hpp"

namespace sphverify {

/// What the quadratures of a moving gas have added up to: momentum and energy given to the gas.
template <int Dim>
struct GasBudgets {
  std::vector<WallExchange<Dim>> walls;
  Vector<Dim> source_impulse = Vector<Dim>::Zero();
  double source_energy = 0.0;
  Vector<Dim> pair_impulse = Vector<Dim>::Zero();  ///< what pairs created
  double pair_energy = 0.0;

  Vector<Dim> exchanged_impulse() const;
  double exchanged_energy() const;
};

/// A moving scene and its integration in time.
template <int Dim>
class MovingGas {
 public:
  /// @param courant_factor part of the usual step limits that a leapfrog takes
  MovingGas(Problem<Dim> problem, SceneChoice const& choice, double courant_factor);

  using Monitor = std::function<std::string(double time, double const* state, GasBudgets<Dim> const& budgets)>;

  /// Integrates to the final time by the named method (leapfrog, runge-kutta), after which the scene is at
  /// the final state. The monitor is called after every step with the state at its end; the scene it sees is
  /// at a state within the step. Throws BrokenRun.
  OdeResult integrate(std::string const& method, Tolerances tolerances, Monitor const& monitor);

  MovingScene<Dim>& scene() { return scene_; }
  MovingScene<Dim> const& scene() const { return scene_; }
  GasBudgets<Dim> budgets(double const* quadratures) const;

  std::map<std::string, std::uint64_t> const& steps_bound_by() const { return steps_bound_by_; }
  double smallest_step() const { return smallest_step_; }
  double largest_step() const { return largest_step_; }

 private:
  std::size_t impulses() const;
  std::size_t quadratures() const;
  void quadrature(double* out) const;
  StepLimit tightest_limit() const;
  double leapfrog_step();

  MovingScene<Dim> scene_;
  double courant_factor_;
  std::map<std::string, std::uint64_t> steps_bound_by_;
  double smallest_step_ = 0.0, largest_step_ = 0.0;
};

extern template class MovingGas<1>;
extern template class MovingGas<2>;
extern template class MovingGas<3>;

}  // namespace sphverify
