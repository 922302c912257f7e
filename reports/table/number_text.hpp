// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "reports/results.hpp"

namespace sphverify {

/// 4.9e-3: short enough for a column each. A number that does not exist is "-", one beyond all is "fails".
std::string scientific(Number const& value);

/// 0.97%, 49%, 1.2e5%; what is rounding is 0%.
std::string percent(Number const& value);

/// +0.97%, -12%
std::string signed_percent(double value);

/// An order and its 95% interval: "1.5±0.1", by the further end; by both, "0.4 (0.2-1.9)", where one half
/// width would reach far beyond the nearer.
std::string order_with_interval(double order, double lower, double upper);

/// Columns on a terminal that a UTF-8 text takes: its code points.
std::size_t text_width(std::string const& text);

/// Words in lines of at most so many columns; a longer word stands alone.
std::vector<std::string> lines_of_words(std::string const& words, std::size_t columns);

/// A head and words in lines of so many columns; all but the first line begin at a column.
std::string hanging_lines(std::string const& head, std::string const& words, std::size_t column,
                          std::size_t columns);

/// Words in lines of so many columns, indented; none at the end.
std::string indented_lines(std::string const& words, std::size_t columns);

}  // namespace sphverify
