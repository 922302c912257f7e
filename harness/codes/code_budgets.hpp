// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cases/support/case.hpp"
#include "harness/codes/snapshot.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// What a code's particles held of mass, momentum and energy, from the first snapshot of a run to the last. What crossed walls
/// in the code is not known. Where by the exact solution nothing crosses them and no source acts, all change is drift; elsewhere
/// exchange and drift are NaN.
/// @param history by ascending time; two or more, else nothing is put down
/// @param keeps_history whether the sums at all times are to be put down
template <int Dim>
void measure_code_budgets(Problem<Dim> const& problem, CaseKind kind, std::vector<Snapshot> const& history,
                          bool keeps_history, RunRecord& record);

}  // namespace sphverify
