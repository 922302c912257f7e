// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sphverify {

/// What is wrong with a text that is to be JSON, and where; lines and columns count from 1, columns in
/// characters.
struct SyntaxError {
  std::size_t line, column;
  std::string found, expected;
};

/// Most lists and objects inside each other.
inline constexpr std::size_t deepest_nesting = 64;

/// The first mistake in a text, in words for whoever wrote it: a trailing or a missing comma, quotes of the
/// wrong kind, an object that is not closed, a key given twice, ... Empty if it is JSON that we read.
std::optional<SyntaxError> find_syntax_error(std::string_view text);

}  // namespace sphverify
