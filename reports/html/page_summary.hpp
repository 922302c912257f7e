// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "reports/html/page_json.hpp"
#include "reports/table/summary.hpp"

namespace sphverify::page {

/// The verdict across the cases of a document, as `sphverify compare` opens with it: a list of groups of
/// scenes, the largest first.
Json summary_json(std::vector<SummaryGroup> const& groups);

}  // namespace sphverify::page
