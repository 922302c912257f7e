// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "reports/results.hpp"

namespace sphverify {

inline constexpr char const* timed_out = "timed-out";

/// The runs of a series at one resolution.
struct ComparedLevel {
  std::multiset<std::uint64_t> seeds;
  bool timed_out = false;  ///< any of them, which depends on what else the machine did
  double smoothing_length = 0.0;
  double tolerance = 0.0;  ///< relative, of adaptive steps; 0: steps of fixed rules, the same everywhere
  Number time_error_share = 0.0;  ///< none: a run with such steps does not know its own
  double round_off = 0.0;
};

/// By resolution.
std::map<int, ComparedLevel> levels_of(Series const& series, std::vector<RunRecord> const& runs,
                                       std::string const& field, std::string const& region);

/// The finest resolution at which both ran the same scene; several seeds may be others, one may not.
std::optional<int> finest_common(std::map<int, ComparedLevel> const& before,
                                 std::map<int, ComparedLevel> const& after);

}  // namespace sphverify
