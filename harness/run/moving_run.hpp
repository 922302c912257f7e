// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "harness/run/run.hpp"
#include "harness/scene/scene.hpp"

namespace sphverify {

/// Runs a moving gas and writes what the options ask for into the record.
///
/// The error of time integration is measured. A leapfrog run is repeated with half the step; runge-kutta from
/// a loose tolerance to tight, a hundredfold at a time, until tightening it once more changes no field's
/// error by more than 1%, in any region and norm. The looser of the last two is the run's result and what it
/// costs. Without Measure::error nothing is compared, and the first rung taken.
template <int Dim>
void run_moving(Problem<Dim> const& problem, SceneChoice const& choice, RunOptions const& options,
                MeasuredRun& run);

/// Set-up and run at the step or tolerance that a record says, without its measurements.
template <int Dim>
Repetition repeat_moving(Problem<Dim> const& problem, SceneChoice const& choice, RunOptions const& options,
                         RunRecord const& record);

}  // namespace sphverify
