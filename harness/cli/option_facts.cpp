// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/cli/option_facts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "reports/user_error.hpp"

namespace sphverify {

namespace {

/// 0 to 2, by which options are shown.
int rank_of(CLI::Option const& option) {
  if (option.check_lname("help") || option.check_lname("version")) return 2;
  return option.get_required() ? 0 : 1;
}

}  // namespace

std::string OptionFacts::head() const {
  std::string text = fmt::format("{}", fmt::join(names, ", "));
  if (!is_positional && !takes.empty()) text += " " + takes;
  return is_list ? text + "..." : text;
}

OptionFacts facts_of(CLI::Option const& option) {
  OptionFacts facts;
  facts.is_positional = option.get_positional();
  facts.is_required = option.get_required();
  bool const takes_any_number = option.get_expected_max() >= CLI::detail::expected_max_vector_size;
  facts.is_list = takes_any_number && (facts.is_positional || option.get_allow_extra_args());
  for (std::string const& name : option.get_snames()) facts.names.push_back("-" + name);
  for (std::string const& name : option.get_lnames()) facts.names.push_back("--" + name);
  // What validators say of themselves follows a colon.
  std::string const type = option.get_type_size() == 0 ? "" : option.get_type_name();
  facts.takes = type.substr(0, type.find(':'));
  if (facts.is_positional) {
    facts.names = {option.get_name(true, false)};
    if (facts.takes.find('|') == std::string::npos) facts.takes = facts.names.front();
  }
  facts.says = option.get_description();
  facts.may_be_repeated = takes_any_number && !facts.is_list;
  if (facts.may_be_repeated) facts.says += "; may be repeated";
  std::set<std::string> others;
  for (CLI::Option const* other : option.get_excludes()) others.insert(other->get_name(false, false));
  if (!others.empty()) facts.says += fmt::format("; not with {}", fmt::join(others, " or "));
  return facts;
}

std::vector<OptionFacts> arguments_of(CLI::App const& command) {
  std::vector<OptionFacts> all;
  for (CLI::Option const* option :
       command.get_options([](CLI::Option const* one) { return one->get_positional(); }))
    all.push_back(facts_of(*option));
  return all;
}

std::vector<OptionFacts> options_of(CLI::App const& command) {
  auto options = command.get_options([](CLI::Option const* one) { return one->nonpositional(); });
  std::stable_sort(options.begin(), options.end(),
                   [](auto const* a, auto const* b) { return rank_of(*a) < rank_of(*b); });
  std::vector<OptionFacts> all;
  for (CLI::Option const* option : options) all.push_back(facts_of(*option));
  return all;
}

CLI::Validator one_of_words(std::vector<std::string> const& words) {
  return CLI::Validator(
      [words](std::string& found) {
        bool const is_known = std::find(words.begin(), words.end(), found) != words.end();
        return is_known ? "" : fmt::format("found '{}', expected {}", found, one_of(found, words));
      },
      "");
}

CLI::Option* take_one_of(CLI::Option* option, std::vector<std::string> const& words) {
  return option->type_name(fmt::format("{}", fmt::join(words, "|")))->check(one_of_words(words));
}

void take_results_format(CLI::App& command, std::string& format) {
  take_one_of(command.add_option("--format", format, "How the results are written; the names are the same [json]"), {"json", "hdf5"});
}

std::vector<std::string> words_of(OptionFacts const& option) {
  std::vector<std::string> words;
  if (option.takes.find('|') == std::string::npos) return words;
  for (std::size_t from = 0; from <= option.takes.size();) {
    std::size_t const to = std::min(option.takes.find('|', from), option.takes.size());
    words.push_back(option.takes.substr(from, to - from));
    from = to + 1;
  }
  return words;
}

}  // namespace sphverify
