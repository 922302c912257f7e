// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace sphverify {

/// Which of the processes this is that were started together to share a study.
struct Rank {
  int number = 0;
  int of = 1;
  std::string job;  ///< what started them; the same for all, another for what was started again
};

/// As `mpirun` (Open MPI, or any whose processes find PMI_RANK) or `srun` say in the environment; else, and where
/// SPHVERIFY_RANKS is `off`, one of one.
Rank rank_of_process();

/// Nobody hears from now on what this process has to say: of several that say the same one is enough.
void fall_silent();

}  // namespace sphverify
