// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reports/json/node.hpp"

namespace sphverify {

/// Something that `list` shows and `describe` explains.
struct CatalogueEntry {
  std::string kind;  ///< formulations, cases, kernels, walls, viscosities, layouts, measures
  std::string id, title, source;
  std::function<Json()> details;  ///< what `describe` tells: label -> text, or a list
};

/// Everything that there is, from the lists of schemes and cases.
std::vector<CatalogueEntry> const& catalogue();

std::vector<std::string> catalogue_kinds();

}  // namespace sphverify
