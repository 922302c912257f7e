// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "reports/table/sections.hpp"
#include "reports/table/summary.hpp"

namespace sphverify {

/// The answer in words, then in a table, controls apart; groups of scenes behind the first in words alone.
/// Empty without series.
std::string summary_text(std::vector<SummaryGroup> const& groups, Comparison const& comparison);

/// What its marks mean.
std::vector<LegendEntry> summary_legend();

/// "density given, h/dx 1.2 (N/25)^0.5": density and h/dx, and between them what else was varied.
std::string setting_text(SummaryRow const& row);

/// A sentence on each formulation but the controls, the one that stands first at the beginning.
std::vector<std::string> sentences(SummaryGroup const& group);

/// Cases, with those parameters in which they differ, and layouts of a group.
std::vector<std::string> cases_of(SummaryGroup const& group);
std::vector<std::string> layouts_of(SummaryGroup const& group);

/// "slab-dirichlet, jitter 0.1": a scene among those of its group.
std::string scene_name(SummaryGroup const& group, std::size_t scene);

}  // namespace sphverify
