// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "reports/html/page_json.hpp"
#include "reports/table/series_row.hpp"

namespace sphverify::page {

/// One ladder: its settings, what the tables show of it, its levels, its errors and what the orders say.
/// @param controls formulations that are yardsticks, besides all without wall terms
Json series_json(Series const& series, SeriesRow const& row, std::vector<RunRecord> const& runs,
                 std::set<std::string> const& controls, Dictionary& word);

}  // namespace sphverify::page
