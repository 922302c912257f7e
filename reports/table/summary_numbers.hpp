// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "reports/json/node.hpp"
#include "reports/table/summary.hpp"

namespace sphverify {

/// A line per formulation and group of scenes, all numbers in full.
std::string summary_csv(std::vector<SummaryGroup> const& groups);

/// An entry per group: its scenes, the answer in words, and an entry per formulation, the best first.
Json summary_json(std::vector<SummaryGroup> const& groups);

}  // namespace sphverify
