// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "reports/columns/column.hpp"

// Columns as an HDF5 file (docs/results-in-hdf5.md says how). The library is an optional part of the build: without it nothing
// can be written, and reading says so in a UserError.
namespace sphverify {

bool can_use_hdf5();

/// Whether these are the bytes of an HDF5 file.
inline bool is_hdf5(std::string_view bytes) { return bytes.starts_with("\x89HDF\r\n\x1a\n"); }

/// The bytes of a file.
/// @param document a column of one object
std::string hdf5_file(Column const& document);

/// Throws UserError, with file and name of the data set, unless these are the bytes of such a file.
Column read_hdf5_file(std::string bytes, std::string const& path);

}  // namespace sphverify
