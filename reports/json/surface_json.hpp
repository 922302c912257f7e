// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "reports/json/node.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// One of a results document's `surfaces`.
Json to_json(Surface const& surface);

/// Reads back what `to_json` wrote. Throws UserError for anything else.
Surface read_surface(Node const& node);

}  // namespace sphverify
