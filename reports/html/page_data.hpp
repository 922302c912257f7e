// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "reports/json/node.hpp"
#include "reports/table/compare.hpp"

namespace sphverify {

/// What the report's page draws, for its scripts alone (reports/page/data.js reads it): a list of documents.
/// Numbers are rounded to five digits. Of every ladder one profile, one history and one spectrum remain,
/// thinned so that the page stays below 3 MB, and the stability and second law of its finest runs.
/// @param controls formulations that are yardsticks: shown apart, never recommended
Json page_data(std::vector<NamedResults> const& documents, std::set<std::string> const& controls);

}  // namespace sphverify
