#pragma once

#include "harness/run/run.hpp"
#include "harness/scene/scene.hpp"

namespace sphverify {

/// Evaluates a scheme once on a case's fields and compares with the exact rate.
template <int Dim>
void run_rates(Problem<Dim> const& problem, SceneChoice const& choice, RunOptions const& options,
               RunRecord& record);

}  // namespace sphverify
