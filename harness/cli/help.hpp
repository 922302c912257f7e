// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

namespace sphverify {

/// Help in lines as long as COLUMNS or the terminal says, else of 80 columns. A line of a footer that is a
/// command ("Example: sphverify ...", or indented) is broken as a shell takes it: with a backslash.
class HelpInColumns : public CLI::Formatter {
 public:
  HelpInColumns();

  std::string make_description(CLI::App const* app) const override;
  std::string make_usage(CLI::App const* app, std::string name) const override;
  std::string make_option(CLI::Option const* option, bool is_positional) const override;
  std::string make_subcommand(CLI::App const* command) const override;
  std::string make_footer(CLI::App const* app) const override;

 private:
  std::string entry(std::string const& name, std::string const& says) const;

  std::size_t columns_;
};

/// Of an option's words; another one is refused with the nearest named.
CLI::Validator one_of_words(std::vector<std::string> const& words);

}  // namespace sphverify
