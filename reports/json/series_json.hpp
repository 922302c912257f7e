// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "reports/json/node.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// A ladder of a results document. Throws UserError.
Series read_series(Node const& node);

}  // namespace sphverify
