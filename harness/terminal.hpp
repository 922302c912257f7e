// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

namespace sphverify {

/// Columns of a line where nobody says how many there are.
inline constexpr std::size_t usual_columns = 80;

/// Columns that a line on standard output has, at least 40: what COLUMNS says, else the terminal at standard
/// output or, beside a pipe, at standard error or input. Empty where none of them says anything.
std::optional<std::size_t> known_columns();

/// Whether a stream is a terminal that can do more than append: TERM is not `dumb`.
bool can_redraw(int stream);

/// Whether colour may be written to a stream: the same, and NO_COLOR is not set, or empty (no-color.org).
bool takes_colour(int stream);

}  // namespace sphverify
