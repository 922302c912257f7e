// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "reports/results.hpp"

namespace sphverify {

/// What a results document is written as, under the same names.
enum class ResultsFormat { json, hdf5 };

/// `json` or `hdf5`. Throws UserError for what this build cannot write.
/// @param command for whose option `--format` the word stands
ResultsFormat results_format(std::string const& word, std::string const& command);

/// That of the file, `json` where there is none.
ResultsFormat format_of_file(std::string const& path);

/// Writes the document so that the file is either the old one or the whole new one; `-` is standard output.
/// Throws UserError when the place cannot be written.
void write_results(std::string const& path, Results const& results, ResultsFormat format);

}  // namespace sphverify
