// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sphverify {

/// What to expect in the place of an unknown identifier where there are more than a line holds: the command
/// that lists them all, and the nearest few: "one of `sphverify list cases` (did you mean 'a'? or b, c)".
std::string one_listed_by(std::string_view command, std::string_view found,
                          std::vector<std::string> identifiers);

}  // namespace sphverify
