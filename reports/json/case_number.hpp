// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "reports/json/node.hpp"

namespace sphverify {

/// A number of a case, 0 or of a size whose products with others of the kind are still numbers. Throws UserError.
double read_case_number(Node const& node);

}  // namespace sphverify
