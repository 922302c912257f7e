#pragma once

#include <string>
#include <vector>

namespace sphverify {

enum class TableFormat { table, markdown, csv, json };

/// A table of text cells; the first columns are labels (left-aligned), the others values.
struct TextTable {
  std::string title;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  std::size_t label_columns = 1;
  std::vector<std::vector<bool>> best;  ///< cells to mark, empty or as `rows`
};

/// @param colour whether the best cells are set off by colour as well as by a star
std::string render(TextTable const& table, TableFormat format, bool colour);

}  // namespace sphverify
