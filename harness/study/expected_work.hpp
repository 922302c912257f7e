// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "harness/run/run.hpp"
#include "harness/study/time_left.hpp"

namespace sphverify {

/// Support of a run's kernel [dx].
double support_of(RunSpec const& run);

/// Runs before any is carried out, with about what each of them does.
std::vector<RunProgress> expected_work(std::vector<RunSpec> const& runs);

}  // namespace sphverify
