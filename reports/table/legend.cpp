// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/legend.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/table/number_text.hpp"

namespace sphverify {

namespace {

std::string in_markdown(std::vector<LegendEntry> const& entries) {
  std::string text;
  for (auto const& [mark, meaning] : entries)
    text += mark.empty() ? fmt::format("- {}\n", meaning) : fmt::format("- `{}`: {}\n", mark, meaning);
  return text;
}

/// Several marks to a line as they fit; a sentence has lines of its own.
std::string in_lines(std::vector<LegendEntry> const& entries, std::size_t columns) {
  constexpr std::size_t gap = 3;
  std::vector<std::string> lines;
  bool is_open = false;  // whether the last line may take another mark
  for (auto const& [mark, meaning] : entries) {
    if (mark.empty()) {
      for (std::string& line : lines_of_words(meaning, columns)) lines.push_back(std::move(line));
      is_open = false;
      continue;
    }
    std::string const entry = mark + ": " + meaning;
    if (text_width(entry) > columns) {
      for (std::string const& line : lines_of_words(entry, columns)) lines.push_back(line);
      is_open = false;
      continue;
    }
    if (is_open && text_width(lines.back()) + gap + text_width(entry) <= columns) {
      lines.back() += std::string(gap, ' ') + entry;
    } else {
      lines.push_back(entry);
    }
    is_open = true;
  }
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

}  // namespace

std::string legend(std::vector<LegendEntry> const& entries, TextStyle const& style) {
  return style.format == TableFormat::markdown ? in_markdown(entries) : in_lines(entries, style.columns);
}

}  // namespace sphverify
