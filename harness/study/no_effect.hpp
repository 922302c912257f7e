// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "harness/study/study.hpp"
#include "reports/json/node.hpp"

namespace sphverify {

/// Refuses what a study asks for and what changes none of its runs: a viscosity of particles at rest, an
/// exponent of a single resolution, a measure that no case has. Defaults may be written out. Throws
/// UserError.
void require_effects(Study const& study, Node const& document);

}  // namespace sphverify
