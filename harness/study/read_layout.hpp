// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "reports/json/node.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// A layout as documents name it: a word, or an object with what it needs; one entry per seed. Throws UserError.
std::vector<LayoutChoice> read_layout(Node const& node);

}  // namespace sphverify
