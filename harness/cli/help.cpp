// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/cli/help.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "harness/terminal.hpp"
#include "reports/table/number_text.hpp"

namespace sphverify {

namespace {

std::vector<std::string> lines_of(std::string const& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Where the command in a line of a footer begins; 0 where it holds none.
std::size_t command_in(std::string const& line) {
  constexpr std::string_view example = "Example: ";
  if (line.starts_with(example)) return example.size();
  return std::min(line.find_first_not_of(' '), line.size());
}

/// Of programs that others make of our libraries the manual is ours, too.
std::string manual_of(CLI::App const& app) {
  return app.get_parent() == nullptr ? "sphverify, man sphverify-study, ..." : "sphverify-" + app.get_name();
}

}  // namespace

std::string command_lines(std::string const& line, std::size_t start, std::size_t columns) {
  if (text_width(line) <= columns) return line + "\n";
  constexpr std::string_view goes_on = " \\";
  std::size_t const indent = start + 2;
  std::string text = line.substr(0, start);
  auto const lines = lines_of_words(line.substr(start), columns - std::min(columns, indent + goes_on.size()));
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (k > 0) text += std::string(goes_on) + "\n" + std::string(indent, ' ');
    text += lines[k];
  }
  return text + "\n";
}

std::string usage_of(CLI::App const& command, std::string const& name) {
  std::string text = name;
  auto const options = options_of(command);
  if (std::any_of(options.begin(), options.end(), [](OptionFacts const& one) { return !one.is_required; }))
    text += " [OPTIONS]";
  for (OptionFacts const& one : options) {
    if (one.is_required) text += " " + one.names.front() + " " + one.takes;
  }
  for (OptionFacts const& one : arguments_of(command))
    text += one.is_required ? " " + one.head() : " [" + one.head() + "]";
  if (!command.get_subcommands({}).empty()) text += " SUBCOMMAND";
  return text;
}

HelpInColumns::HelpInColumns() : columns_(known_columns().value_or(usual_columns)) {
  column_width(std::min(get_column_width(), 3 * columns_ / 8));
}

std::string HelpInColumns::entry(std::string const& name, std::string const& says) const {
  std::size_t const width = get_column_width();
  std::string head = hanging_lines("  ", name, 6, columns_);
  head.pop_back();
  std::string text;
  if (head.find('\n') == std::string::npos && text_width(head) + 1 < width) {
    head.resize(head.size() + width - text_width(head), ' ');
  } else {
    text = head + "\n";
    head.assign(width, ' ');
  }
  for (std::string const& line : lines_of(says)) {
    text += hanging_lines(head, line, width, columns_);
    head.assign(width, ' ');
  }
  return text;
}

std::string HelpInColumns::entries(std::string const& title, std::vector<OptionFacts> const& options) const {
  if (options.empty()) return "";
  std::string text = "\n" + title + ":\n";
  for (OptionFacts const& option : options) text += entry(option.head(), option.says);
  return text;
}

std::string HelpInColumns::subcommands(CLI::App const& app) const {
  auto const all = app.get_subcommands({});
  if (all.empty()) return "";
  std::string text = "\nSubcommands:\n";
  for (CLI::App const* command : all) text += entry(command->get_name(), command->get_description());
  return text;
}

std::string HelpInColumns::footer(CLI::App const& app) const {
  std::string text = "\n";
  for (std::string const& line : lines_of(app.get_footer())) {
    std::size_t const command = command_in(line);
    text += command > 0 ? command_lines(line, command, columns_) : hanging_lines("", line, 0, columns_);
  }
  return text;
}

std::string HelpInColumns::make_help(CLI::App const* app, std::string name, CLI::AppFormatMode) const {
  return hanging_lines("", app->get_description(), 0, columns_) +
         hanging_lines("", "Usage: " + usage_of(*app, name), 4, columns_) + subcommands(*app) +
         entries("Arguments", arguments_of(*app)) + entries("Options", options_of(*app)) + footer(*app) +
         hanging_lines("", "Manual: man " + manual_of(*app), 0, columns_);
}

}  // namespace sphverify
