// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <istream>
#include <string>
#include <vector>

#include "harness/measure/order.hpp"

namespace sphverify {

/// One column of errors of a table that somebody else measured.
struct LadderColumn {
  std::string name;
  std::vector<LadderLevel> levels;  ///< coarse to fine, rows of one spacing merged as replicates
};

/// Reads comma-separated values. The first line names the columns: `N` (particles along an axis, spacing 1/N)
/// or `spacing`, `seed` if wanted, and errors. Lines that begin with # are left out, an empty cell or `nan`
/// is a run without an error. A cell may stand in quotation marks, and the text begin with a byte order mark.
/// Levels differ by 1e-6 of themselves or more. Throws UserError with file, line and column.
std::vector<LadderColumn> read_ladder_table(std::istream& text, std::string const& file);

/// The same from a file, or from standard input where it is called `-`.
std::vector<LadderColumn> read_ladder_table(std::string const& path);

}  // namespace sphverify
