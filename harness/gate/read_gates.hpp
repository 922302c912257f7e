// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "harness/gate/gates.hpp"
#include "reports/json/node.hpp"

namespace sphverify {

/// Reads a gates document, sphverify-gates/1. Throws UserError for an unknown key, for a key that does not go
/// with the measure, and for a limit that the measure does not have.
Gates read_gates(Node const& document);

/// The words of `measure` in the order of GateMeasure.
std::vector<std::string> const& gate_measure_words();

}  // namespace sphverify
