#include "reports/table/text_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "reports/table/number_text.hpp"

namespace sphverify {

namespace {

std::string padded(std::string const& text, std::size_t width) {
  return text + std::string(width - std::min(width, text_width(text)), ' ');
}

bool is_best(TextTable const& table, std::size_t row, std::size_t column) {
  return !table.best.empty() && table.best[row][column];
}

std::string marked(TextTable const& table, std::size_t row, std::size_t column) {
  return table.rows[row][column] + (is_best(table, row, column) ? "*" : "");
}

/// The columns in blocks that fit a terminal; each begins with the labels.
std::vector<std::vector<std::size_t>> blocks_of(TextTable const& table,
                                                std::vector<std::size_t> const& width) {
  std::vector<std::size_t> labels;
  std::size_t label_width = 0;  // with the gaps behind them
  for (std::size_t c = 0; c < table.label_columns; ++c) {
    labels.push_back(c);
    label_width += width[c] + 2;
  }
  std::vector<std::vector<std::size_t>> blocks{labels};
  std::size_t taken = label_width;
  for (std::size_t c = table.label_columns; c < width.size(); ++c) {
    if (taken + width[c] > terminal_columns && blocks.back().size() > labels.size()) {
      blocks.push_back(labels);
      taken = label_width;
    }
    blocks.back().push_back(c);
    taken += width[c] + 2;
  }
  return blocks;
}

std::string render_terminal(TextTable const& table, bool colour) {
  std::vector<std::size_t> width;
  for (std::string const& name : table.header) width.push_back(text_width(name));
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    for (std::size_t c = 0; c < table.rows[r].size(); ++c)
      width[c] = std::max(width[c], text_width(marked(table, r, c)));
  }
  std::string text = table.title + "\n";
  auto const line = [&](std::vector<std::size_t> const& columns, auto const& cell) {
    std::string row;
    for (std::size_t const c : columns) row += (c == 0 ? "" : "  ") + cell(c);
    while (row.ends_with(' ')) row.pop_back();
    text += row + "\n";
  };
  bool is_first = true;
  for (auto const& columns : blocks_of(table, width)) {
    if (!is_first) text += "\n";
    is_first = false;
    line(columns, [&](std::size_t c) { return padded(table.header[c], width[c]); });
    line(columns, [&](std::size_t c) { return std::string(width[c], '-'); });
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      line(columns, [&](std::size_t c) {
        std::string const cell = padded(marked(table, r, c), width[c]);
        return colour && is_best(table, r, c) ? "\x1b[1;32m" + cell + "\x1b[0m" : cell;
      });
    }
  }
  return text;
}

std::string render_markdown(TextTable const& table) {
  std::string text = fmt::format("### {}\n\n| {} |\n|", table.title, fmt::join(table.header, " | "));
  for (std::size_t c = 0; c < table.header.size(); ++c) text += "---|";
  text += "\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    text += "|";
    for (std::size_t c = 0; c < table.rows[r].size(); ++c) text += " " + marked(table, r, c) + " |";
    text += "\n";
  }
  return text;
}

std::string csv_cell(std::string const& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (char const c : cell) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string render_csv(TextTable const& table) {
  std::string text;
  auto const line = [&](std::vector<std::string> const& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) text += (c > 0 ? "," : "") + csv_cell(cells[c]);
    text += "\n";
  };
  line(table.header);
  for (auto const& row : table.rows) line(row);
  return text;
}

}  // namespace

std::string render(TextTable const& table, TableFormat format, bool colour) {
  switch (format) {
    case TableFormat::markdown:
      return render_markdown(table);
    case TableFormat::csv:
      return render_csv(table);
    default:
      return render_terminal(table, colour);
  }
}

}  // namespace sphverify
