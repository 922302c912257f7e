// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "reports/table/series_row.hpp"
#include "reports/table/text_table.hpp"

namespace sphverify {

/// What a case's series created of energy and momentum, how stable they are and whether heat flowed from cold
/// to hot: those tables for which the documents have numbers.
/// @param rows of one case, at least one
std::vector<TextTable> budget_tables(std::vector<SeriesRow> const& rows);

}  // namespace sphverify
