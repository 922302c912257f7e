// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "harness/gate/gates.hpp"

namespace sphverify {

/// The keys of a discretisation that are words.
std::vector<std::string> const& discretisation_words();

bool matches(FormulationMatch const& match, FormulationChoice const& formulation);

/// Whether a run is selected; `matches` of a series leaves resolutions and seeds aside.
bool matches(Select const& select, RunRecord const& run);
bool matches(Select const& select, Series const& series);

/// Why a gate looks at nothing: the first key that no run matches, alone or with those before it, what there
/// is instead, and what may have been meant; or that what it selects is only what it compares to, or has no
/// such level.
std::string why_empty(Gate const& gate, Results const& results);

/// The first entry of a list in `select` that, alone in its place, selects nothing, and why; empty if every
/// entry selects something.
std::string unmatched_entry(Gate const& gate, Results const& results);

}  // namespace sphverify
