// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "reports/json/node.hpp"
#include "reports/table/series_row.hpp"

namespace sphverify {

/// A line, or an entry, per series with all its words and numbers in full.
std::string series_csv(std::vector<SeriesRow> const& rows);
Json series_json(std::vector<SeriesRow> const& rows);

}  // namespace sphverify
