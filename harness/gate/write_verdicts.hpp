// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "harness/gate/gates.hpp"
#include "harness/gate/text.hpp"

namespace sphverify {

/// One line per gate (verdict, name, measured, limit), then what there is to say of those that do not simply
/// pass, then a summary on the last line. As wide as said.
std::string verdicts_text(std::vector<GateVerdict> const& verdicts, bool colour,
                          std::size_t columns = widest_line);

/// A JUnit document: one test case per gate; an expected failure is a skipped one, everything else that does
/// not hold a failure.
std::string verdicts_junit(Gates const& gates, std::vector<GateVerdict> const& verdicts);

/// A summary in Markdown, with a table.
std::string verdicts_markdown(Gates const& gates, std::vector<GateVerdict> const& verdicts);

/// Workflow commands by which GitHub shows failures (and expected failures, as notices) beside the code.
std::string verdicts_annotations(Gates const& gates, std::vector<GateVerdict> const& verdicts);

/// "12 gates: 10 passed, 1 expected-failure, 1 failed"
std::string verdicts_summary(std::vector<GateVerdict> const& verdicts);

/// Everything that there is to say of a gate beside its numbers: what failed, where, and why.
std::vector<std::string> remarks(GateVerdict const& verdict);

}  // namespace sphverify
