// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace sphverify {

/// Names that tell documents apart: the file's name without its ending, with as many folders before it as
/// that takes ("old/results"); of a file given twice with a number behind it.
std::vector<std::string> document_names(std::vector<std::string> const& paths);

}  // namespace sphverify
