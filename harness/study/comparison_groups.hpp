// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "harness/run/run.hpp"

namespace sphverify {

/// Groups of runs that take turns when they are timed: those that differ in the formulation alone (on the
/// same case, discretisation, seed and resolution), whose times are compared.
/// @return for each run the number of its group, counted as groups first appear
std::vector<std::size_t> comparison_groups(std::vector<RunSpec> const& runs);

/// The same of what is asked for: where nothing is timed again each run is a group by itself.
std::vector<std::size_t> timing_groups(std::vector<RunSpec> const& runs, MeasureSet const& measure, RepeatRule const& repeat);

}  // namespace sphverify
