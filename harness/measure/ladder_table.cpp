// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/ladder_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "reports/json/places.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

namespace {

constexpr double smallest = 1e-30, largest = 1e30;            // of N and spacings
constexpr double least_difference = 1e-6;                     // of two spacings, relative
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // some programs begin UTF-8 with it
constexpr double double_round_off = 1e-300;                   // an error of 0 says nothing of the order

std::string trimmed(std::string const& text) {
  std::size_t const first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Where a cell stands, for complaints.
struct Place {
  std::string const& file;
  std::size_t line;
  std::string column;
  std::size_t character = 1;  ///< of the line, at which it begins

  [[noreturn]] void complain(std::string const& found, std::string const& expected) const {
    throw UserError(place_text(file, {line, character}), column, found, expected);
  }
  Place at(std::size_t another) const { return {file, line, column, another}; }
};

struct TableCell {
  std::string text;
  std::size_t character;
};

/// The cell that begins at `from`, which is moved behind the comma after it. Within quotation marks a comma
/// is text, and two marks are one.
TableCell next_cell(std::string const& line, std::size_t& from, Place const& place) {
  std::size_t const first = line.find_first_not_of(" \t", from);
  std::size_t const character = place_in(line, first).column;  // of an empty cell that of the comma after it, or the end
  if (first == std::string::npos || line[first] != '"') {
    std::size_t const to = std::min(line.find(',', from), line.size());
    std::string const cell = trimmed(line.substr(from, to - from));
    from = to + 1;
    return {cell, character};
  }
  std::string cell;
  std::size_t k = first + 1;
  for (; k < line.size() && !(line[k] == '"' && (k + 1 == line.size() || line[k + 1] != '"')); ++k) {
    cell += line[k];
    if (line[k] == '"') ++k;
  }
  std::size_t const to = std::min(line.find(',', k), line.size());
  if (k >= line.size() || !trimmed(line.substr(k + 1, to - k - 1)).empty())
    place.at(character).complain("'" + trimmed(line.substr(first)) + "'", "a quotation mark at either end of a cell");
  from = to + 1;
  return {trimmed(cell), character};
}

std::vector<TableCell> cells_of(std::string const& line, Place const& place) {
  std::vector<TableCell> cells;
  for (std::size_t from = 0; from <= line.size();) cells.push_back(next_cell(line, from, place));
  return cells;
}

std::optional<double> number_in(TableCell const& one, Place const& of_line) {
  std::string const& cell = one.text;
  Place const place = of_line.at(one.character);
  if (cell.empty() || cell == "nan" || cell == "NaN") return std::nullopt;
  double value = 0.0;
  char const* const begin = cell.data() + (cell.front() == '+' ? 1 : 0);
  auto const [end, error] = std::from_chars(begin, cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value))
    place.complain("'" + cell + "'", "a number");
  return value;
}

struct Header {
  std::vector<std::string> names;
  std::size_t spacing = 0;
  bool is_resolution = false;  ///< the spacing's column is N
  std::optional<std::size_t> seed;
};

Header read_header(std::vector<TableCell> const& cells, Place const& of_line) {
  Header header;
  for (TableCell const& cell : cells) header.names.push_back(cell.text);
  std::vector<std::string> const& names = header.names;
  std::set<std::string> seen;
  std::optional<std::size_t> spacing;
  for (std::size_t k = 0; k < names.size(); ++k) {
    Place const place = of_line.at(cells[k].character);
    if (std::any_of(names[k].begin(), names[k].end(), [](unsigned char c) { return c < 0x20 || c >= 0x7f; }))
      place.complain("a name with control characters or letters beyond ASCII", "plain words");
    if (names[k].empty()) place.complain("a column without a name", "a name for each column");
    if (!seen.insert(names[k]).second) place.complain("'" + names[k] + "' twice", "a name for each column");
    if (names[k] == "seed") header.seed = k;
    if (names[k] != "N" && names[k] != "spacing") continue;
    if (spacing) place.complain("N and spacing", "one of the two");
    spacing = k;
    header.is_resolution = names[k] == "N";
  }
  if (!spacing)
    of_line.complain(fmt::format("'{}'", names.front()), "names, N or spacing among them, with commas between");
  header.spacing = *spacing;
  if (names.size() < (header.seed ? 3u : 2u))
    of_line.complain("no column of errors", "one or more beside N or spacing");
  return header;
}

/// The order between two levels that hardly differ is that of their rounding.
void require_apart(std::set<std::pair<double, double>> const& runs, std::string const& name,
                   bool is_resolution, std::string const& file) {
  double before = 0.0;
  for (auto const& [spacing, seed] : runs) {
    if (spacing != before && before > 0.0 && spacing < before * (1.0 + least_difference)) {
      auto const shown = [&](double d) {
        return is_resolution ? fmt::format("{:.15g}", 1.0 / d) : fmt::format("{}", d);
      };
      throw UserError(file, name, fmt::format("{} and {}", shown(before), shown(spacing)),
                      fmt::format("levels that differ by {:g} of themselves or more", least_difference));
    }
    before = spacing;
  }
}

}  // namespace

std::vector<LadderColumn> read_ladder_table(std::istream& text, std::string const& file) {
  std::optional<Header> header;
  // column -> spacing, coarse first -> errors; a level with a run that has none has none.
  struct Replicates {
    std::vector<double> errors;
    bool is_whole = true;
  };
  std::vector<std::map<double, Replicates, std::greater<>>> errors;
  std::set<std::pair<double, double>> runs;
  std::string line;
  for (std::size_t number = 1; std::getline(text, line); ++number) {
    if (number == 1 && line.starts_with(byte_order_mark)) line.erase(0, byte_order_mark.size());
    if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
    std::vector<TableCell> const cells = cells_of(line, {file, number, "columns"});
    if (!header) {
      header = read_header(cells, {file, number, "names"});
      errors.resize(cells.size());
      continue;
    }
    if (cells.size() != header->names.size()) {
      Place{file, number, "columns"}.complain(
          fmt::format("{}", cells.size()), fmt::format("{}, as in the line of names", header->names.size()));
    }
    TableCell const& n_or_spacing = cells[header->spacing];
    Place const of_spacing{file, number, header->names[header->spacing], n_or_spacing.character};
    auto const given = number_in(n_or_spacing, of_spacing);
    if (!given || *given < smallest || *given > largest)
      of_spacing.complain("'" + n_or_spacing.text + "'", "a number above 0, from 1e-30 to 1e30");
    double const spacing = header->is_resolution ? 1.0 / *given : *given;
    if (header->seed) {
      auto const seed = number_in(cells[*header->seed], {file, number, "seed"});
      if (!runs.emplace(spacing, seed.value_or(0.0)).second)
        Place{file, number, "seed", cells[*header->seed].character}.complain("'" + cells[*header->seed].text + "' twice at one spacing",
                                             "each seed once");
    } else if (!runs.emplace(spacing, 0.0).second) {
      of_spacing.complain("'" + n_or_spacing.text + "' twice", "each once, or a column seed");
    }
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (k == header->spacing || (header->seed && k == *header->seed)) continue;
      Place const place{file, number, header->names[k], cells[k].character};
      auto const error = number_in(cells[k], place);
      Replicates& level = errors[k][spacing];
      if (!error) {
        level.is_whole = false;
        continue;
      }
      if (*error < 0.0) place.complain("'" + cells[k].text + "'", "an error, 0 or larger");
      level.errors.push_back(*error);
    }
  }
  if (!header) throw UserError(file, "names", "an empty table", "a line of names and lines of numbers");
  if (runs.empty()) throw UserError(file, "rows", "none", "one line of numbers per run");
  require_apart(runs, header->names[header->spacing], header->is_resolution, file);
  std::vector<LadderColumn> columns;
  for (std::size_t k = 0; k < header->names.size(); ++k) {
    if (k == header->spacing || (header->seed && k == *header->seed)) continue;
    LadderColumn column{header->names[k], {}};
    for (auto& [spacing, level] : errors[k])
      column.levels.push_back(
          {spacing, level.is_whole ? level.errors : std::vector<double>{}, double_round_off});
    columns.push_back(std::move(column));
  }
  return columns;
}

std::vector<LadderColumn> read_ladder_table(std::string const& path) {
  if (path == "-") return read_ladder_table(std::cin, "standard input");
  std::ifstream file(path);
  if (!file)
    throw UserError("order", "TABLE.csv", "'" + path + "', which cannot be read",
                    "a file, or - for standard input");
  return read_ladder_table(file, path);
}

}  // namespace sphverify
