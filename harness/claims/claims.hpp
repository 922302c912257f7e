// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "formulations/scheme.hpp"

namespace sphverify {

/// How a scheme kept one of its claims.
struct ClaimResult {
  std::string claim;      ///< in words, as "conserves energy between particles"
  bool claimed = true;    ///< false: looked at all the same, since a reader wants to know
  double found = 0.0;     ///< the defect, relative to what it is made of; the largest over dimensions and kernels
  double allowed = 0.0;   ///< what rounding explains
  std::string where;      ///< of the largest: dimension and kernel
  bool is_looked_at = true;  ///< in any dimension, with any kernel
  std::string remark{};      ///< in which dimensions no kernel would do, and why; may be empty

  bool holds() const { return is_looked_at && found <= allowed; }
  /// What cannot be looked at is not kept.
  bool fails() const { return claimed && !holds(); }
};

/// Holds a scheme to what it claims (SchemeInfo::conserves, SchemeInfo::claims) and to what every scheme must do: in one to
/// three dimensions, with every kernel, on random particles between walls and on lattices. A scheme that refuses a kernel
/// (std::invalid_argument) is held to the others.
std::vector<ClaimResult> check_claims(SchemeInfo const& scheme);

}  // namespace sphverify
