// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace sphverify {

/// Columns of a line where no terminal says how many it has.
inline constexpr std::size_t widest_line = 100;

/// Columns on a terminal that a UTF-8 text takes: its code points.
std::size_t width_of(std::string const& text);

/// Padded to a width of at least 2, or cut to it with two dots at its end.
std::string fitted(std::string const& text, std::size_t width);

/// A text that came from elsewhere, on one line.
std::string without_control(std::string text);

/// Words on lines of at most so many columns, each with its newline: the first indented by two blanks,
/// further ones by four.
std::string wrapped(std::string const& text, std::size_t columns = widest_line);

}  // namespace sphverify
