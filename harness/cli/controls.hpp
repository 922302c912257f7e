// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>

namespace sphverify {

/// Identifiers of the schemes that are yardsticks: shown beside the others, never recommended.
std::set<std::string> control_ids();

}  // namespace sphverify
