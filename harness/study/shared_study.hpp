// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "harness/study/journal.hpp"
#include "harness/study/progress.hpp"
#include "harness/study/ranks.hpp"
#include "harness/study/study_units.hpp"

namespace sphverify {

/// A study whose units several processes carry out.
struct SharedStudy {
  Study const& study;
  std::vector<RunSpec> const& specs;
  RunOptions options;
  std::string results;  ///< where its results go; beside them ranks find rank 0
  std::string identity;  ///< of study, build and plug-ins: the same in all ranks
  int workers = 1;      ///< of each rank: how many units it carries out at a time
};

/// Rank 0: gives the units out, the longest first, to workers of its own and to those of all other ranks, and keeps the
/// journal. A unit whose process or rank dies is tried once more; then the run that it was at is `crashed`, and the
/// rest of the unit goes on. Where fewer units are left than workers and no times are measured, a run has more threads.
/// Throws Interrupted.
/// @return all runs that were finished, by their place in the journal
std::map<std::size_t, RunRecord> share_study(SharedStudy const& shared, Rank const& rank, Journal& journal, Progress& progress);

/// All other ranks: carry out what rank 0 gives out until it says that there is no more, or is gone. Throws Interrupted,
/// and std::runtime_error where rank 0 cannot be found.
void work_for_rank_0(SharedStudy const& shared, Rank const& rank);

}  // namespace sphverify
