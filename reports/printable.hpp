// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sphverify {

/// Bytes of the character of UTF-8 that a text begins with; 0 if it begins with none.
std::size_t utf8_size(std::string_view text);

/// A text on one line that leaves a terminal as it is: control characters (C0, C1, delete), line separators
/// and what turns the direction of writing are written as \n, \t, \u001b, and bytes that are not UTF-8 as
/// \xff. What comes from a user's input is printed as this.
std::string printable(std::string_view text);

}  // namespace sphverify
