// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "reports/table/summary.hpp"
#include "reports/table/text_table.hpp"

namespace sphverify {

/// The setting that all formulations but controls stand at; empty where they differ.
std::string shared_setting(SummaryGroup const& group);

/// A line per formulation, with its setting below unless all share it.
/// @param controls whether those, or the others
TextTable summary_table(SummaryGroup const& group, bool controls);

}  // namespace sphverify
