// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace sphverify {

/// What an option or a positional argument says of itself: to the help, to the manual and to the shell that completes it.
struct OptionFacts {
  std::vector<std::string> names;  ///< -o, --output; of a positional argument its one name
  /// What its value is: FILE, CASE, N, ..., or words with bars between them. Of a flag empty. Of a positional argument its
  /// name, unless it takes words.
  std::string takes;
  bool is_positional = false, is_required = false;
  bool is_list = false;          ///< takes several values at once
  bool may_be_repeated = false;  ///< with one value each time
  std::string says;      ///< with what is said of every option of its kind

  /// "-o, --output FILE", "STUDY.json", "PART.json..."
  std::string head() const;
};

OptionFacts facts_of(CLI::Option const& option);

/// Positional arguments, in their order.
std::vector<OptionFacts> arguments_of(CLI::App const& command);

/// Options: required ones first, --help and --version last.
std::vector<OptionFacts> options_of(CLI::App const& command);

/// Refuses other words than these, and names the nearest.
CLI::Validator one_of_words(std::vector<std::string> const& words);

/// Lets an option take one of these words alone, and shows them in place of its value.
CLI::Option* take_one_of(CLI::Option* option, std::vector<std::string> const& words);

/// --format of a command that writes results.
void take_results_format(CLI::App& command, std::string& format);

/// The words that an option takes alone; none where it takes something else.
std::vector<std::string> words_of(OptionFacts const& option);

}  // namespace sphverify
