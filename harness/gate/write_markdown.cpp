// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/gate/write_verdicts.hpp"

namespace sphverify {

namespace {

/// Text as itself in a cell of a table: no markup, no HTML, no end of the cell.
std::string cell(std::string const& text) {
  std::string escaped;
  for (char const c : text) {
    if (c == '&') {
      escaped += "&amp;";
    } else if (c == '<') {
      escaped += "&lt;";
    } else if (c == '\n') {
      escaped += ' ';
    } else {
      if (std::string_view("\\|`*_[]#").find(c) != std::string_view::npos) escaped += '\\';
      escaped += c;
    }
  }
  return escaped;
}

}  // namespace

std::string verdicts_markdown(Gates const& gates, std::vector<GateVerdict> const& verdicts) {
  std::string text = fmt::format("### Gates: {}\n\n{}\n\n", cell(gates.name), verdicts_summary(verdicts));
  text += "| verdict | gate | measured | limit | remarks |\n|---|---|---|---|---|\n";
  for (GateVerdict const& one : verdicts) {
    std::string const verdict(word(one.verdict));
    text += fmt::format("| {} | {} | {} | {} | {} |\n", holds(one.verdict) ? verdict : "**" + verdict + "**",
                        cell(one.name), cell(one.measured), cell(one.limit),
                        cell(fmt::format("{}", fmt::join(remarks(one), "; "))));
  }
  return text;
}

}  // namespace sphverify
