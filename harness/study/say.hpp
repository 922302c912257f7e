// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "reports/results.hpp"

namespace sphverify {

/// What is said on standard error at the end of a study: how many runs ended how, unless all are ok; why runs
/// were refused (it is the input that was wrong, not a formulation); what was remarked; and of how many runs
/// it is not known how much of the error is the time integration's. Each reason once.
void say_how_it_went(std::vector<RunRecord> const& runs);

/// Why nothing of a study ran, of which every combination was skipped, on one line.
std::string why_nothing_ran(std::vector<Skipped> const& skipped);

}  // namespace sphverify
