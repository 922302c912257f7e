// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/changes_level.hpp"

#include <algorithm>
#include <cmath>

#include "reports/extremes.hpp"
#include "reports/find_error.hpp"

namespace sphverify {

std::map<int, ComparedLevel> levels_of(Series const& series, std::vector<RunRecord> const& runs,
                                       std::string const& field, std::string const& region) {
  std::map<int, ComparedLevel> levels;
  for (std::size_t const index : series.runs) {
    RunRecord const& run = runs[index];
    ComparedLevel& level = levels[run.resolution];
    level.seeds.insert(run.discretisation.layout.seed);
    level.timed_out = level.timed_out || run.status == timed_out;
    level.smoothing_length = run.smoothing_length;
    if (run.integration && run.integration->relative_tolerance) {
      level.tolerance = std::max(level.tolerance, *run.integration->relative_tolerance);
      level.time_error_share = larger_if_known(level.time_error_share, run.integration->time_error_share);
    }
    if (RegionError const* const error = find_error(run, field, region))
      level.round_off = std::max(level.round_off, error->round_off);
  }
  return levels;
}

std::optional<int> finest_common(std::map<int, ComparedLevel> const& before,
                                 std::map<int, ComparedLevel> const& after) {
  for (auto a = before.rbegin(); a != before.rend(); ++a) {
    auto const b = after.find(a->first);
    if (b == after.end()) continue;
    double const h = a->second.smoothing_length;
    bool const same_path = std::abs(h - b->second.smoothing_length) <= 1e-9 * h;
    bool const same_seeds = a->second.seeds == b->second.seeds;
    bool const has_spreads = a->second.seeds.size() > 1 && b->second.seeds.size() > 1;
    if (same_path && (same_seeds || has_spreads)) return a->first;
  }
  return std::nullopt;
}

}  // namespace sphverify
