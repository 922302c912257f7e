// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "harness/run/run.hpp"
#include "harness/scene/scene.hpp"

namespace sphverify {

/// Runs heat conduction on frozen particles and writes what the options ask for into the record.
///
/// The tolerance of the time integration is chosen by measurement: from loose to tight, a hundredfold at a
/// time, the first is taken at which tightening it once more changes the final temperature by less than 1% of
/// the space error, in every region and norm. Each formulation so pays for the accuracy that it delivers, and
/// no more.
template <int Dim>
void run_conduction(Problem<Dim> const& problem, SceneChoice const& choice, RunOptions const& options,
                    MeasuredRun& run);

/// Set-up and run at the tolerance that a record says, without its measurements.
template <int Dim>
Repetition repeat_conduction(Problem<Dim> const& problem, SceneChoice const& choice,
                             RunOptions const& options, RunRecord const& record);

}  // namespace sphverify
