// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "harness/cli/option_facts.hpp"

namespace sphverify {

/// "sphverify exact [OPTIONS] -t TIME CASE"
std::string usage_of(CLI::App const& command, std::string const& name);

/// A line whose command begins at `start`, broken as a shell takes it where it is longer than so many columns.
std::string command_lines(std::string const& line, std::size_t start, std::size_t columns);

/// Help in lines as long as COLUMNS or the terminal says, else of 80 columns. A line of a footer that is a
/// command ("Example: sphverify ...", or indented) is broken as a shell takes it: with a backslash.
class HelpInColumns : public CLI::FormatterBase {
 public:
  HelpInColumns();

  std::string make_help(CLI::App const* app, std::string name, CLI::AppFormatMode mode) const override;

 private:
  std::string entry(std::string const& name, std::string const& says) const;
  std::string entries(std::string const& title, std::vector<OptionFacts> const& options) const;
  std::string subcommands(CLI::App const& app) const;
  std::string footer(CLI::App const& app) const;

  std::size_t columns_;
};

}  // namespace sphverify
