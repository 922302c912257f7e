// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "reports/table/sections.hpp"

namespace sphverify {

/// Per case tables of errors with orders and verdicts, of wall fluxes, budgets and stability, of the time to
/// 1%; at the end how the ladders of all cases ended. Empty without series.
std::string series_text(Comparison const& comparison);

/// What their marks mean.
std::vector<LegendEntry> series_legend();

}  // namespace sphverify
