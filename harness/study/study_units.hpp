// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "harness/study/study.hpp"

namespace sphverify {

/// What one process carries out in one go: a run, runs that take turns when they are timed, or the search of an envelope.
struct StudyUnit {
  std::vector<std::size_t> runs;  ///< by their number among all
  std::size_t ladder = 0;         ///< of the first
  double work = 0.0;              ///< as `expected_work` counts it
};

/// In the order of their first runs.
std::vector<StudyUnit> study_units(Study const& study, std::vector<RunSpec> const& runs);

/// Where records of a run's envelope begin in the journal; of single runs, where they are.
std::size_t journal_place(Study const& study, std::size_t run);

}  // namespace sphverify
