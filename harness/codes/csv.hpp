// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "harness/codes/snapshot.hpp"

namespace sphverify {

/// Reads comma-separated values: lines that begin with # may say `# time = 0.05` and `# gamma = 1.4`, then a line of names,
/// then one line per particle. Columns that nobody asked for are passed over; `nan` and `inf` are read as they are. Numbers
/// of few digits are taken to be rounded to them. Throws UserError with file, line and column.
/// @param names column -> what the file calls it, where that is another name
Snapshot read_csv_snapshot(std::string const& path, std::map<std::string, std::string> const& names);

/// Text that `read_csv_snapshot` reads back to the bit. Numbers in the shortest form that does.
std::string csv_text(Snapshot const& snapshot);

}  // namespace sphverify
