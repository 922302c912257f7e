// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include "harness/study/study_units.hpp"

namespace sphverify {

/// Where runs are announced and handed in, by their place in the journal.
struct RunsTold {
  /// Of a search: what is there already.
  std::function<std::optional<RunRecord>(std::size_t place, RunSpec const& spec)> known;
  std::function<void(std::size_t place)> started;
  std::function<void(std::size_t place, RunRecord record)> finished;
};

/// Carries out a unit in this process.
/// @param specs all runs of the study
/// Throws Interrupted.
void carry_out(Study const& study, std::vector<RunSpec> const& specs, StudyUnit const& unit, RunOptions const& options,
               RunsTold const& told);

}  // namespace sphverify
