// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/codes/external_code.hpp"

#include <algorithm>
#include <filesystem>

namespace sphverify {

namespace {

std::vector<std::string> const placeholders{"{initial}", "{final}", "{case}", "{time}", "{resolution}", "{seed}", "{threads}",
                                            "{here}"};

/// A word that is a placeholder of nothing, such as {finale}: what it stands for is nowhere in the word.
void require_known(Node const& word) {
  std::string const text = word.string();
  bool const looks_like_one = text.size() > 2 && text.front() == '{' && text.back() == '}' &&
                              std::all_of(text.begin() + 1, text.end() - 1, [](char c) { return c >= 'a' && c <= 'z'; });
  if (looks_like_one && std::find(placeholders.begin(), placeholders.end(), text) == placeholders.end())
    word.complain(one_of(text, placeholders));
}

bool holds(std::vector<std::string> const& command, char const* placeholder) {
  return std::any_of(command.begin(), command.end(),
                     [&](std::string const& word) { return word.find(placeholder) != std::string::npos; });
}

}  // namespace

void require_external_name(Node const& id, std::string const& name) {
  bool const is_plain = !name.empty() && name.size() <= 100 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
  });
  if (!is_plain) id.complain("external/NAME, the name of letters, digits, '-', '_' and '.'");
}

ExternalCode read_external_code(Node const& object) {
  std::vector<std::string> keys{"id", "command", "initial", "disk_budget", "keep"};
  keys.insert(keys.end(), snapshot_option_keys.begin(), snapshot_option_keys.end());
  object.require_keys(keys);
  ExternalCode code;
  code.id = object.at("id").string();
  require_external_name(object.at("id"), code.id.substr(std::string(external_prefix).size()));
  Node const command = object.at("command");
  if (!command.is_array()) command.complain(R"(a list of words, such as ["./solver", "{initial}", "{final}"]: no shell reads them)");
  for (Node const& word : command.elements()) {
    require_known(word);
    code.command.push_back(word.string());
  }
  if (code.command.empty() || code.command.front().empty()) command.complain("the program first, then its arguments");
  if (!holds(code.command, "{initial}") || !holds(code.command, "{final}"))
    command.complain("{initial} and {final} among the words: the files to read and to write");
  // It runs elsewhere.
  std::string& program = code.command.front();
  if (program.find('/') != std::string::npos && program.front() != '/' && program.front() != '{')
    program = (std::filesystem::current_path() / program).lexically_normal().string();
  code.options = read_snapshot_options(object);
  std::string const& format = code.options.format;
  bool const is_initial_too = std::find(initial_formats.begin(), initial_formats.end(), format) != initial_formats.end();
  if (is_initial_too) code.initial = format;
  if (auto const initial = object.find("initial")) code.initial = initial->word(initial_formats);
  if (auto const budget = object.find("disk_budget")) code.disk_budget = budget->number_between(1e-6, 1e6);
  if (auto const keep = object.find("keep")) code.keep = keep->string();
  return code;
}

Json to_json(ExternalCode const& code) {
  Json json = {{"id", code.id}, {"command", code.command}, {"initial", code.initial}, {"disk_budget", code.disk_budget}};
  if (!code.keep.empty()) json["keep"] = code.keep;
  json.update(to_json(code.options));
  return json;
}

}  // namespace sphverify
