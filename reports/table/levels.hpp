// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "reports/json/node.hpp"
#include "reports/table/compare.hpp"
#include "reports/table/legend.hpp"
#include "reports/table/setting.hpp"
#include "reports/table/text_table.hpp"

namespace sphverify {

/// The error of one field in one region of one run; of a run that has none, such as one that failed, the run
/// alone, with an empty field and region.
struct LevelRow : Setting {
  std::string case_id, parameters, formulation, label, status, field, region;
  int resolution = 0;
  std::size_t particles = 0;
  Number spacing, smoothing_length;  ///< [m]
  Number seconds;
  Number l1, l2, linf;
  Number scale_l1, scale_l2, scale_linf;        ///< the same norms of the exact field
  Number initial_l1, initial_l2, initial_linf;  ///< the error if nothing were done
  Number mean;                                  ///< of computed - exact, with its sign
  Number round_off;
};

/// Those of all runs, in the order of the documents.
std::vector<LevelRow> level_rows(std::vector<NamedResults> const& documents);

/// Per case, field, region, layout and refinement path a table with a line per run.
std::string levels_text(std::vector<LevelRow> const& rows, TextStyle const& style);
std::vector<LegendEntry> levels_legend();

/// Long format: a line, or an entry, per run, field and region, all numbers in full. No cell holds a comma,
/// so that nothing has to be told to what reads it.
std::string levels_csv(std::vector<LevelRow> const& rows);
Json levels_json(std::vector<LevelRow> const& rows);

}  // namespace sphverify
