// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/pivot.hpp"

#include <algorithm>

namespace sphverify {

namespace {

std::vector<Setting> settings_of(std::vector<SeriesRow> const& rows) { return {rows.begin(), rows.end()}; }

/// The place of a name among those seen so far, at whose end it is put if it is new.
template <class Name>
std::size_t place_of(std::vector<Name>& names, Name const& name) {
  auto const place = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  if (place == names.size()) names.push_back(name);
  return place;
}

/// The best of the cells that compete, and those that read the same; none where all do.
std::vector<bool> best_of(std::vector<Cell> const& cells) {
  Cell const* best = nullptr;
  for (Cell const& cell : cells) {
    if (cell.value && (best == nullptr || *cell.value < *best->value)) best = &cell;
  }
  std::vector<bool> marks;
  for (Cell const& cell : cells) {
    marks.push_back(best != nullptr && cell.value && (cell.value == best->value || cell.text == best->text));
  }
  bool const is_no_choice = std::find(marks.begin(), marks.end(), false) == marks.end();
  return is_no_choice ? std::vector<bool>(cells.size(), false) : marks;
}

std::vector<Cell> column_of(std::vector<std::vector<Cell>> const& cells, std::size_t column) {
  std::vector<Cell> result;
  for (auto const& row : cells) result.push_back(row[column]);
  return result;
}

/// Puts the marks of a column beside its cells.
void mark(TextTable& table, std::size_t first_row, std::size_t column, std::vector<bool> const& marks) {
  for (std::size_t k = 0; k < marks.size(); ++k) table.best[first_row + k][column] = marks[k];
}

}  // namespace

TextTable pivot(std::string const& title, std::vector<SeriesRow> const& rows,
                std::function<Cell(SeriesRow const&)> const& cell_of) {
  SettingNames const names(settings_of(rows));
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> keys;
  std::vector<std::pair<std::size_t, std::size_t>> places;
  for (SeriesRow const& row : rows)
    places.emplace_back(place_of(keys, names.row(row)), place_of(columns, names.column(row)));

  TextTable table;
  table.title = title;
  table.header = names.header();
  table.label_columns = table.header.size();
  table.header.insert(table.header.end(), columns.begin(), columns.end());
  std::vector<std::vector<Cell>> cells(keys.size(), std::vector<Cell>(columns.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) cells[places[k].first][places[k].second] = cell_of(rows[k]);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    auto& texts = table.rows.emplace_back(keys[k]);
    for (Cell const& cell : cells[k]) texts.push_back(cell.text);
    table.best.emplace_back(texts.size(), false);
  }
  for (std::size_t c = 0; c < columns.size(); ++c)
    mark(table, 0, table.label_columns + c, best_of(column_of(cells, c)));
  return table;
}

TextTable number_table(std::string const& title, std::vector<SeriesRow> const& rows,
                       std::vector<NumberColumn> const& columns) {
  SettingNames const names(settings_of(rows));
  std::vector<std::string> layouts;
  for (SeriesRow const& row : rows) place_of(layouts, names.column(row));

  TextTable table;
  table.title = title;
  table.header = names.header();
  table.header.emplace_back("layout");
  table.label_columns = table.header.size();
  for (NumberColumn const& column : columns) table.header.push_back(column.name);
  for (std::string const& layout : layouts) {
    std::size_t const first_row = table.rows.size();
    std::vector<std::vector<Cell>> cells;
    for (SeriesRow const& row : rows) {
      if (names.column(row) != layout) continue;
      auto& line = cells.emplace_back();
      for (NumberColumn const& column : columns) line.push_back(column.cell_of(row));
      auto& texts = table.rows.emplace_back(names.row(row));
      texts.push_back(layout);
      for (Cell const& cell : line) texts.push_back(cell.text);
      table.best.emplace_back(texts.size(), false);
    }
    for (std::size_t c = 0; c < columns.size(); ++c)
      mark(table, first_row, table.label_columns + c, best_of(column_of(cells, c)));
  }
  return table;
}

}  // namespace sphverify
