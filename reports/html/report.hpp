// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "reports/table/compare.hpp"

namespace sphverify {

/// Whether the program was built with the plotting library of the page.
bool can_write_page();

/// One self-contained HTML page that shows the documents one after another: verdicts, plots, tables. It needs
/// no network. Throws std::runtime_error if the program was built without the plotting library.
/// @param controls formulations that are yardsticks: shown apart, never recommended
std::string report_page(std::vector<NamedResults> const& documents, std::set<std::string> const& controls);

}  // namespace sphverify
