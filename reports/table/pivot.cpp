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
  std::vector<Number> best(columns.size());
  for (auto const& row : cells) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (row[c].value && (!best[c] || *row[c].value < *best[c])) best[c] = row[c].value;
    }
  }
  for (std::size_t k = 0; k < keys.size(); ++k) {
    std::vector<std::string> texts = keys[k];
    std::vector<bool> marks(table.label_columns, false);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      Cell const& cell = cells[k][c];
      texts.push_back(cell.text);
      marks.push_back(keys.size() > 1 && cell.value && cell.value == best[c]);
    }
    table.rows.push_back(std::move(texts));
    table.best.push_back(std::move(marks));
  }
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
    std::vector<SeriesRow const*> members;
    for (SeriesRow const& row : rows) {
      if (names.column(row) == layout) members.push_back(&row);
    }
    std::vector<std::vector<Cell>> cells;
    std::vector<Number> best(columns.size());
    for (SeriesRow const* row : members) {
      auto& line = cells.emplace_back();
      for (std::size_t c = 0; c < columns.size(); ++c) {
        line.push_back(columns[c].cell_of(*row));
        Number const& value = line.back().value;
        if (value && (!best[c] || *value < *best[c])) best[c] = value;
      }
    }
    for (std::size_t k = 0; k < members.size(); ++k) {
      std::vector<std::string> texts = names.row(*members[k]);
      texts.push_back(layout);
      std::vector<bool> marks(table.label_columns, false);
      for (std::size_t c = 0; c < columns.size(); ++c) {
        texts.push_back(cells[k][c].text);
        marks.push_back(members.size() > 1 && cells[k][c].value && cells[k][c].value == best[c]);
      }
      table.rows.push_back(std::move(texts));
      table.best.push_back(std::move(marks));
    }
  }
  return table;
}

}  // namespace sphverify
