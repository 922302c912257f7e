// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "reports/results.hpp"

namespace sphverify {

/// How the numbers of two runs of the same scene agree.
struct Agreement {
  /// An error that differs: relative to the larger of the two, 1 where only one of the runs has it.
  struct Difference {
    std::string field, region, norm;
    Number before, now;
    double relative = 0.0;
  };
  std::size_t numbers = 0;      ///< that one of the runs has at least; times are none of them
  std::size_t differing = 0;    ///< of these, not equal to the bit
  std::string first_differing;  ///< where it stands in the record: "conservation/energy/drift"
  std::optional<Difference> worst_error;
};

/// Compares all numbers of two records but times and how they were taken.
Agreement agreement(RunRecord const& before, RunRecord const& now);

/// One line: "all 137 agree to the bit", or how many do not and which error moved most.
std::string agreement_text(Agreement const& agreement);

}  // namespace sphverify
