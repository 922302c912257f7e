// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>

#include "harness/gate/gates.hpp"

namespace sphverify {

/// What a case's reference solution promises.
struct ReferenceAccuracy {
  double value;
  bool relative;  ///< that of a gas counts as a part of its fields, any other in the unit of the main field
};

/// With these parameters, as `sphverify exact` prints it; empty for a case that this program does not know.
std::optional<ReferenceAccuracy> reference_accuracy(std::string const& case_id,
                                                    std::map<std::string, ParameterValue> const& parameters);

/// Throws UserError if a limit on an error (or a skill, or on the error of a wall flux, or a target of
/// time_to_error) is smaller than what the reference solution is accurate to: such a gate would judge the
/// reference. Velocities of a gas are held against its speed of sound where that is larger: a gas at rest has
/// no other.
void require_reachable(Gate const& gate, Measured const& measured, std::string const& file);

}  // namespace sphverify
