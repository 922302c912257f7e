// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "reports/table/text_table.hpp"

namespace sphverify {

/// What a mark in a table means; without a mark a sentence about the tables.
struct LegendEntry {
  std::string mark, meaning;
};

/// What stands below tables: on a terminal in lines of marks, in Markdown a list.
std::string legend(std::vector<LegendEntry> const& entries, TextStyle const& style);

}  // namespace sphverify
