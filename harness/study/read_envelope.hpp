// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "harness/study/study.hpp"
#include "reports/json/node.hpp"

namespace sphverify {

/// h/dx, from 0.001 to 1e6.
double read_smoothing_ratio(Node const& node);

/// How far a study drives its runs. Both ends are to make sense for every case. Throws UserError.
EnvelopeChoice read_envelope(Node const& node, Study const& study);

}  // namespace sphverify
