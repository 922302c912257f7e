// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "reports/json/node.hpp"
#include "reports/table/changes.hpp"

namespace sphverify {

/// What changed, to be read: the documents, counts, and the largest changes.
std::string changes_text(Changes const& changes, CompareOptions const& options);

/// All changes, a line each, with all numbers in full.
std::string changes_csv(std::vector<Changes> const& changes);

/// The same, with the counts.
Json changes_json(std::vector<Changes> const& changes);

}  // namespace sphverify
