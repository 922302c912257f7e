// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "harness/run/moving_gas.hpp"
#include "harness/scene/moving_scene.hpp"
#include "reports/results.hpp"

// What is measured of a gas that has come to its end, and where it is put down.
namespace sphverify {

/// Heat through each wall of which the exact flux is known.
template <int Dim>
void measure_wall_flux(Problem<Dim> const& problem, MovingScene<Dim> const& scene, RunRecord& record);

/// The exact solution's shocks, and the gas nearest each wall: how much too hot it is, the worst of them in motion.wall_heating.
template <int Dim>
void measure_shocks(Problem<Dim> const& problem, MovingScene<Dim> const& scene, RunRecord& record, Motion& motion);

/// Mass, momentum and energy at the beginning and now, and what crossed the walls.
template <int Dim>
void measure_budgets(Problem<Dim> const& problem, SceneChoice const& choice, MovingScene<Dim> const& scene,
                     GasBudgets<Dim> const& budgets, RunRecord& record);

/// A history with no more instants than a document should hold, the first and the last among them.
History thinned(History const& history);

}  // namespace sphverify
