// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/text_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "reports/printable.hpp"
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
std::vector<std::vector<std::size_t>> blocks_of(TextTable const& table, std::vector<std::size_t> const& width,
                                                std::size_t columns) {
  std::vector<std::size_t> labels;
  std::size_t label_width = 0;  // with the gaps behind them
  for (std::size_t c = 0; c < table.label_columns; ++c) {
    labels.push_back(c);
    label_width += width[c] + 2;
  }
  std::vector<std::vector<std::size_t>> blocks{labels};
  std::size_t taken = label_width;
  for (std::size_t c = table.label_columns; c < width.size(); ++c) {
    if (taken + width[c] > columns && blocks.back().size() > labels.size()) {
      blocks.push_back(labels);
      taken = label_width;
    }
    blocks.back().push_back(c);
    taken += width[c] + 2;
  }
  return blocks;
}

/// Lines of a title in lines that fit.
std::string title_of(std::string const& title, std::size_t columns) {
  std::string text;
  for (std::size_t start = 0; start <= title.size();) {
    std::size_t const end = std::min(title.find('\n', start), title.size());
    std::size_t const words = std::min(title.find_first_not_of(' ', start), end);
    std::string const indent(words - start, ' ');
    text += hanging_lines(indent, title.substr(words, end - words), indent.size(), columns);
    start = end + 1;
  }
  return text;
}

/// The words of a column's name that stay together: a number stays with its quantity, "h/dx 1.2".
std::vector<std::string> parts_of(std::string const& name) {
  std::vector<std::string> parts;
  for (std::string const& word : lines_of_words(name, 1)) {
    bool const is_number = !word.empty() && std::isdigit(static_cast<unsigned char>(word.front())) != 0;
    if (is_number && !parts.empty()) {
      parts.back() += " " + word;
    } else {
      parts.push_back(word);
    }
  }
  return parts;
}

/// Lines of a name that are as wide as said, or as its widest part.
std::vector<std::string> lines_of_parts(std::string const& name, std::size_t columns) {
  std::vector<std::string> lines;
  for (std::string const& part : parts_of(name)) {
    if (!lines.empty() && text_width(lines.back()) + 1 + text_width(part) <= columns) {
      lines.back() += " " + part;
    } else {
      lines.push_back(part);
    }
  }
  return lines;
}

/// A table whose columns have widths and whose names have lines.
struct Laid {
  std::vector<std::size_t> width;
  std::vector<std::vector<std::string>> names;  ///< of each column, as many lines as it takes

  explicit Laid(TextTable const& table) {
    for (std::string const& name : table.header) {
      std::size_t widest = 0;
      for (std::string const& part : parts_of(name)) widest = std::max(widest, text_width(part));
      width.push_back(widest);
    }
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      for (std::size_t c = 0; c < table.rows[r].size(); ++c)
        width[c] = std::max(width[c], text_width(marked(table, r, c)));
    }
    for (std::size_t c = 0; c < width.size(); ++c) names.push_back(lines_of_parts(table.header[c], width[c]));
  }

  /// The line of a column's name, the last of all columns on the same height.
  std::string name(std::size_t column, std::size_t line, std::size_t lines) const {
    std::size_t const above = lines - names[column].size();
    return line < above ? "" : names[column][line - above];
  }
};

std::string render_terminal(TextTable const& table, TextStyle const& style) {
  Laid const laid(table);
  std::string text = table.title.empty() ? "" : title_of(table.title, style.columns);
  auto const line = [&](std::vector<std::size_t> const& columns, auto const& cell) {
    std::string row;
    for (std::size_t const c : columns) row += (c == 0 ? "" : "  ") + cell(c);
    while (row.ends_with(' ')) row.pop_back();
    text += row + "\n";
  };
  bool is_first = true;
  for (auto const& columns : blocks_of(table, laid.width, style.columns)) {
    if (!is_first) text += "\n";
    bool const has_notes = is_first && !table.notes.empty();
    is_first = false;
    std::size_t lines = 1;
    for (std::size_t const c : columns) lines = std::max(lines, laid.names[c].size());
    for (std::size_t k = 0; k < lines; ++k)
      line(columns, [&](std::size_t c) { return padded(laid.name(c, k, lines), laid.width[c]); });
    line(columns, [&](std::size_t c) { return std::string(laid.width[c], '-'); });
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      line(columns, [&](std::size_t c) {
        std::string const cell = padded(marked(table, r, c), laid.width[c]);
        return style.colour && is_best(table, r, c) ? "\x1b[1;32m" + cell + "\x1b[0m" : cell;
      });
      if (has_notes && !table.notes[r].empty()) text += hanging_lines("  ", table.notes[r], 2, style.columns);
    }
  }
  return text;
}

/// Notes as a last column.
TextTable with_notes_beside(TextTable table) {
  if (table.notes.empty()) return table;
  table.header.push_back(table.note_name);
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    table.rows[r].push_back(table.notes[r]);
    if (!table.best.empty()) table.best[r].push_back(false);
  }
  return table;
}

std::string render_markdown(TextTable const& table) {
  std::string text = table.title.empty() ? "" : fmt::format("### {}\n\n", table.title);
  text += fmt::format("| {} |\n|", fmt::join(table.header, " | "));
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

/// Titles may have several lines.
std::string printable_lines(std::string_view text) {
  std::string out;
  for (std::size_t start = 0; start <= text.size();) {
    std::size_t const end = std::min(text.find('\n', start), text.size());
    if (start > 0) out += '\n';
    out += printable(text.substr(start, end - start));
    start = end + 1;
  }
  return out;
}

}  // namespace

std::string render(TextTable const& as_given, TextStyle const& style) {
  // Names come from documents, which may hold anything.
  TextTable table = as_given;
  table.title = printable_lines(table.title);
  for (std::string& name : table.header) name = printable_lines(name);
  for (auto& row : table.rows) {
    for (std::string& cell : row) cell = printable_lines(cell);
  }
  for (std::string& note : table.notes) note = printable_lines(note);
  switch (style.format) {
    case TableFormat::markdown:
      return render_markdown(with_notes_beside(table));
    case TableFormat::csv:
      return render_csv(with_notes_beside(table));
    default:
      return render_terminal(table, style);
  }
}

}  // namespace sphverify
