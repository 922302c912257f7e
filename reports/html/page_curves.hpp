// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "reports/html/page_json.hpp"

namespace sphverify::page {

/// Fields along the particles, of each series its finest run that kept them, thinned.
/// @param share how many documents share the room of the page
Json profiles_json(Results const& results, std::size_t share);

/// Budgets over time, likewise.
Json histories_json(Results const& results, std::size_t share);

}  // namespace sphverify::page
