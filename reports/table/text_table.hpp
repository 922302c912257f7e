// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace sphverify {

enum class TableFormat { table, markdown, csv, json };

/// How text is written, and how much room a line of it has.
struct TextStyle {
  TableFormat format = TableFormat::table;
  bool colour = false;       ///< whether the best cells are set off by colour as well as by a star
  std::size_t columns = 80;  ///< of a line of TableFormat::table; the others are never broken
};

/// A table of text cells; the first columns are labels (left-aligned), the others values.
struct TextTable {
  std::string title;  ///< lines, of which blanks at the beginning are kept where they are broken
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  std::size_t label_columns = 1;
  std::vector<std::vector<bool>> best;  ///< cells to mark, empty or as `rows`

  /// Words about each row, empty or as `rows`: on a terminal in lines below it, else in a last column.
  std::string note_name{};
  std::vector<std::string> notes{};
};

/// On a terminal names of columns are broken at blanks where their cells are narrower, and columns that do
/// not fit beside the others stand in further blocks, which repeat the labels.
std::string render(TextTable const& table, TextStyle const& style);

}  // namespace sphverify
