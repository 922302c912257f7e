// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cases/support/case.hpp"
#include "harness/codes/snapshot.hpp"
#include "harness/codes/snapshot_options.hpp"
#include "harness/run/run.hpp"

namespace sphverify {

/// What a code's particles are held against.
struct AssessedCase {
  Case const* scene_case;
  AnyProblem problem;  ///< with the final time that the study or document says
  Discretisation discretisation;
  int resolution;
  double smoothing_ratio;  ///< nominal h/dx, where snapshots have no h
};

/// How far the time of the last snapshot may be from the case's final time, relative to it. The exact solution is taken at the
/// snapshot's own time.
inline constexpr double time_slack = 0.01;

/// Measures a code's particles against a case: errors by field and region, shocks, and what they held of mass, momentum and
/// energy from the first snapshot to the last. Reads nothing of how the code came there: no wall terms, no formulation. Fills
/// the record's numbers, status and remarks.
/// @param history of one run, by ascending time; the last one is judged
/// Throws UserError where a snapshot cannot be one of that case.
void assess_snapshots(AssessedCase const& one, std::vector<Snapshot> history, SnapshotOptions const& options,
                      MeasureSet measure, RunRecord& record);

}  // namespace sphverify
