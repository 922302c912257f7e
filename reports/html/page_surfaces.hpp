// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>

#include "reports/html/page_json.hpp"

namespace sphverify::page {

/// Errors over resolution and h/dx: the cells, the fitted law, the best h/dx at each resolution, the paths of
/// least cost and the rules beside them.
Json surfaces_json(Results const& results, std::set<std::string> const& controls, Dictionary& word);

}  // namespace sphverify::page
