// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "reports/table/series_row.hpp"
#include "reports/table/text_table.hpp"

namespace sphverify {

/// Over everything that was run, at every setting: how often each formulation converged, and how near it
/// came.
TextTable ladder_counts(std::vector<SeriesRow> const& rows, CompareOptions const& options);

}  // namespace sphverify
