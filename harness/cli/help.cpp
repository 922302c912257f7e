// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/cli/help.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "harness/terminal.hpp"
#include "reports/table/number_text.hpp"
#include "reports/user_error.hpp"

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

}  // namespace

HelpInColumns::HelpInColumns() : columns_(known_columns().value_or(usual_columns)) {
  column_width(std::min(get_column_width(), 3 * columns_ / 8));
}

std::string HelpInColumns::make_description(CLI::App const* app) const {
  return hanging_lines("", app->get_description(), 0, columns_);
}

std::string HelpInColumns::make_usage(CLI::App const* app, std::string name) const {
  std::string usage = Formatter::make_usage(app, std::move(name));
  while (usage.ends_with('\n')) usage.pop_back();
  return hanging_lines("", usage, 4, columns_);
}

std::string HelpInColumns::entry(std::string const& name, std::string const& says) const {
  std::size_t const width = get_column_width();
  std::string head = hanging_lines("  ", name, 6, columns_);
  head.pop_back();
  std::string text;
  if (head.find('\n') == std::string::npos && text_width(head) < width) {
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

std::string HelpInColumns::make_option(CLI::Option const* option, bool is_positional) const {
  return entry(make_option_name(option, is_positional) + make_option_opts(option), make_option_desc(option));
}

std::string HelpInColumns::make_subcommand(CLI::App const* command) const {
  return entry(command->get_name(), command->get_description());
}

std::string HelpInColumns::make_footer(CLI::App const* app) const {
  std::string text;
  for (std::string const& line : lines_of(app->get_footer())) {
    std::size_t const command = command_in(line);
    text += command > 0 ? command_lines(line, command, columns_) : hanging_lines("", line, 0, columns_);
  }
  return text;
}

CLI::Validator one_of_words(std::vector<std::string> const& words) {
  return CLI::Validator(
      [words](std::string& found) {
        bool const is_known = std::find(words.begin(), words.end(), found) != words.end();
        return is_known ? "" : fmt::format("found '{}', expected {}", found, one_of(found, words));
      },
      "");
}

}  // namespace sphverify
