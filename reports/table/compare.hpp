// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "reports/results.hpp"
#include "reports/table/text_table.hpp"

namespace sphverify {

struct CompareOptions {
  TextStyle style;
  std::string region = "all";
  std::string norm;                ///< empty: l1 where the solution jumps, l2 elsewhere
  std::string section;             ///< one of reports/table/sections.hpp; empty: all that are shown unasked
  bool legend = false;             ///< whether the marks are explained below the tables
  std::set<std::string> controls;  ///< formulations that are yardsticks: shown apart, never recommended
};

/// A results document and the name that tells it from others.
struct NamedResults {
  std::string name;
  Results results;
};

/// Formulations side by side, in the sections of reports/table/sections.hpp. On a terminal and in Markdown
/// one after the other, the answer first; CSV is the table of one section (by default of the series, or of
/// the envelopes where there are no series); JSON holds all sections that are shown unasked, and the one
/// asked for.
std::string compare(std::vector<NamedResults> const& documents, CompareOptions const& options);

}  // namespace sphverify
