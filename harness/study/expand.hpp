// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "harness/study/study.hpp"

namespace sphverify {

/// The runs of a study, and the combinations that make no sense with the reason why.
struct Expansion {
  std::vector<RunSpec> runs;
  std::vector<Skipped> skipped;
};

/// Every combination of a study that makes sense, in a fixed order: case, formulation, discretisation,
/// refinement path, then resolution.
Expansion expand(Study const& study);

}  // namespace sphverify
