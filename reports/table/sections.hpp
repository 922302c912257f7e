// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "reports/json/node.hpp"
#include "reports/table/legend.hpp"
#include "reports/table/series_row.hpp"

namespace sphverify {

/// What sections are made of. It must not outlive the documents and the options.
struct Comparison {
  std::vector<NamedResults> const& documents;
  CompareOptions const& options;
  std::vector<SeriesRow> rows;  ///< one per series
};

/// A part of a comparison: what `--section` names.
struct Section {
  std::string name;
  std::string key;   ///< in JSON
  std::string says;  ///< for the help
  /// On a terminal and in Markdown; empty where there is nothing to show.
  std::string (*text)(Comparison const&);
  std::string (*csv)(Comparison const&);
  Json (*json)(Comparison const&);
  std::vector<LegendEntry> (*legend)();
  bool is_unasked = true;    ///< shown without being named
  std::string own_errors{};  ///< which region and norm it is of, where one cannot choose them
};

/// All sections, in the order in which they are shown.
std::vector<Section> const& sections();

}  // namespace sphverify
