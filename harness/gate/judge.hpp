// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/gate/gates.hpp"

namespace sphverify {

/// Results documents that `within` compares to, by path.
using Baselines = std::map<std::string, Results>;

/// Reads the baselines that the gates name. Throws UserError for one that is missing, and for one that is the
/// results themselves, with which nothing can disagree.
Baselines read_baselines(Gates const& gates, std::string const& results_path);

/// Judges every gate: it must hold for each run or series that it selects. Throws UserError for names that
/// exist nowhere and for limits below the accuracy of the reference.
std::vector<GateVerdict> judge(Gates const& gates, Results const& results, Baselines const& baselines);

}  // namespace sphverify
