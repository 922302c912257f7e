// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "reports/json/node.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// Measures the snapshots that a document names (sphverify-snapshots/1) as runs of `external/NAME`: those of one resolution and
/// seed are one run's history, whose last one is judged. Gives the results document with orders over resolutions. Files are
/// named from where the document is. Throws UserError.
/// @param output where the results will go, which is to be none of them; - for standard output
Results assess(Node const& document, std::string const& output);

}  // namespace sphverify
