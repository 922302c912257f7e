// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "reports/results.hpp"

namespace sphverify {

/// Whether runs of a document were timed on several machines. Their times say more of the machines than of the
/// formulations: nothing divides one by the other, nor sets one beside the other.
inline bool are_timed_apart(std::vector<RunRecord> const& runs) {
  std::string const* machine = nullptr;
  return std::any_of(runs.begin(), runs.end(), [&](RunRecord const& run) {
    if (!run.cost) return false;
    if (machine == nullptr) machine = &run.cost->machine;
    return run.cost->machine != *machine;
  });
}

}  // namespace sphverify
