// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

#include "reports/json/node.hpp"

namespace sphverify {

/// A text as JSON; nothing where it is none that read_json_file would take: what is nested without end would be the end of
/// whoever looks into it.
std::optional<Json> parse_json(std::string_view text);

}  // namespace sphverify
