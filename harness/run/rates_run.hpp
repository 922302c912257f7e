// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "harness/run/run.hpp"
#include "harness/scene/scene.hpp"

namespace sphverify {

/// Evaluates a scheme once on a case's fields and compares with the exact rate.
template <int Dim>
void run_rates(Problem<Dim> const& problem, SceneChoice const& choice, RunOptions const& options,
               MeasuredRun& run);

/// One batch of set-ups and evaluations; the first call finds how many make one, which warms up.
template <int Dim>
Repetition repeat_rates(Problem<Dim> const& problem, SceneChoice const& choice);

}  // namespace sphverify
