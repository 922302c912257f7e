// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "harness/gate/gates.hpp"

namespace sphverify {

/// How one number that a `within` gate looks at changes when the results become the baseline.
struct BaselineChange {
  std::string gate, where;
  Number before, after;  ///< before is empty where there was none
};

/// What new baselines mean, and the files to write.
struct Rebaseline {
  std::vector<std::string> paths;
  std::vector<BaselineChange> changes;
};

/// Compares the results to the old baselines, which may be missing. Throws UserError if no gate has a
/// baseline, or if a number does not exist in the results: no later run could agree with it.
Rebaseline plan_rebaseline(Gates const& gates, Results const& results, std::string const& results_path);

/// Old, new and their difference of every number that changes.
std::string rebaseline_text(Rebaseline const& plan);

}  // namespace sphverify
