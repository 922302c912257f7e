// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "harness/run/run.hpp"

namespace sphverify {

/// A run of a code that is not ours: writes the case's initial particles, starts the command in a folder of its own, reads the
/// particles that it wrote and holds them against the case. A command that fails, takes too long, writes too much or nothing
/// that can be read ends the run as `failed`, with the last line that it printed.
/// Expects a spec with a code. Throws Interrupted.
void run_code(AnyProblem const& problem, RunSpec const& spec, RunOptions const& options, MeasuredRun& run);

/// The command once more, for its time.
Repetition repeat_code(AnyProblem const& problem, RunSpec const& spec, RunOptions const& options);

}  // namespace sphverify
