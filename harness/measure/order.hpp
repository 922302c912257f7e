#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/results.hpp"

namespace sphverify {

/// One level of a refinement ladder: a spacing and the errors of its replicates (one per seed, or a single
/// one).
struct LadderLevel {
  double spacing;              ///< [any unit]
  std::vector<double> errors;  ///< absolute; empty if no run of this level ended well
  double round_off;            ///< error that rounding alone explains, in the same unit
  bool out_of_time =
      false;  ///< it has none since its runs did not get the time, whatever they were about to do
};

/// Observed order of convergence with its 95% interval, and the verdict on the ladder.
///
/// The order is the slope of log(mean error) over log(spacing) by least squares. Its interval is Student's t
/// on the residuals (levels - 2 degrees of freedom); where levels have replicates the slope's uncertainty
/// from their spread is computed as well, with its own t, and the wider of the two is reported. Levels whose
/// error is at round-off say nothing of the order and are left out. The rules of the verdict are in
/// `verdict_rules`.
/// @param levels coarse to fine
ObservedOrder observed_order(std::vector<LadderLevel> const& levels);

/// The rules of the verdicts, as `describe` prints them.
extern std::string_view const verdict_rules;

}  // namespace sphverify
