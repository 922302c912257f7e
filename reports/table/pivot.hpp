// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reports/table/series_row.hpp"
#include "reports/table/text_table.hpp"

namespace sphverify {

struct Cell {
  std::string text;
  Number value;  ///< by which the best is found; the lower the better
};

/// Formulations down and layouts across: one number of every series. The best of each column is marked.
TextTable pivot(std::string const& title, std::vector<SeriesRow> const& rows,
                std::function<Cell(SeriesRow const&)> const& cell_of);

/// One of several numbers of a series.
struct NumberColumn {
  std::string name;
  std::function<Cell(SeriesRow const&)> cell_of;
};

/// Formulations and layouts down and several numbers across. The best formulation on each layout is marked.
TextTable number_table(std::string const& title, std::vector<SeriesRow> const& rows,
                       std::vector<NumberColumn> const& columns);

}  // namespace sphverify
