// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "reports/html/page_json.hpp"

namespace sphverify::page {

/// The table of all runs: `columns` and `rows`.
/// @param series_of of every run the index of its series, or the number of series for a run that is in none
Json runs_json(Results const& results, std::vector<std::size_t> const& series_of, Dictionary& word);

/// Of each series the run of the finest resolution that holds something; between replicates the one of the
/// largest `weight`, else the first. Pairs of a series and a run.
std::vector<std::pair<std::size_t, std::size_t>> one_per_series(
    Results const& results, std::function<bool(RunRecord const&)> const& holds,
    std::function<double(RunRecord const&)> const& weight);

/// All replicates of a series' finest resolution that has a run for which `holds` is true: of these, those
/// for which it is.
std::vector<std::size_t> finest_runs(Results const& results, Series const& series,
                                     std::function<bool(RunRecord const&)> const& holds);

}  // namespace sphverify::page
