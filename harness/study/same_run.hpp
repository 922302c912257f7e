// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "harness/run/run.hpp"

namespace sphverify {

/// Whether a record is that of a run, and not of another one of the study or of an edited document.
inline bool is_of(RunRecord const& record, RunSpec const& spec) {
  return record.case_id == spec.scene_case->info.id && record.parameters == spec.parameters.all() &&
         record.formulation == spec.formulation && record.discretisation == spec.discretisation &&
         record.smoothing_exponent == spec.smoothing_exponent && record.resolution == spec.resolution;
}

}  // namespace sphverify
