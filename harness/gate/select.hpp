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

/// Why a selection is empty: the first key that no run matches, and what there is instead.
std::string why_empty(Select const& select, Results const& results);

}  // namespace sphverify
