// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/cli/shell/candidates.hpp"
#include "harness/cli/shell/shell_files.hpp"

namespace sphverify {

namespace {

using Kind = Candidates::Kind;

constexpr char const* head = R"zsh(#compdef sphverify
# Completion of sphverify for zsh, made by the build from the program's own options.
# A program with parts of its own is completed likewise, parts included: compdef _sphverify my-verify

# Identifiers with their titles, as the program lists them: of one kind, or all.
_sphverify_listed() {
  local -a lines
  lines=(${(f)"$(_call_program identifiers ${(q)program} list $1 2> /dev/null)"})
  [[ -n $1 ]] || lines=(${(M)lines:#  *})
  lines=(${lines##[[:blank:]]##})
  lines=(${lines/[[:blank:]]##/:})
  _describe -t identifiers identifier lines
}

# Names of the parameters of the case that stands in the command.
_sphverify_parameters() {
  local -a lines
  [[ $PREFIX == *=* ]] && return 1
  lines=(${(f)"$(_call_program parameters ${(q)program} describe ${(q)${words[(r)[a-z]*/*]}} 2> /dev/null)"})
  # Below the heading `parameters` a line begins with two blanks and a name.
  lines=(${lines[${lines[(i)parameters]} + 1,-1]})
  lines=(${(M)lines:#  [a-z_0-9]## *})
  compadd -S = -- ${${lines##  }%% *}
}

)zsh";

/// Within single quotes of a specification, where brackets and colons have a meaning.
std::string escaped(std::string const& words) {
  std::string text;
  for (char const c : words.substr(0, words.find('\n'))) {
    if (c == '\'') {
      text += "'\\''";
      continue;
    }
    if (c == '[' || c == ']' || c == ':' || c == '\\') text += '\\';
    text += c;
  }
  return text;
}

/// A blank before a function of ours: it is then called with these words alone.
std::string action_of(OptionFacts const& option) {
  Candidates const candidates = candidates_of(option);
  switch (candidates.kind) {
    case Kind::words:
      return fmt::format("({})", fmt::join(candidates.words, " "));
    case Kind::files:
      return candidates.of.empty() ? "_files" : fmt::format("_files -g \"*.{}\"", candidates.of);
    case Kind::listed:
      return " _sphverify_listed" + (candidates.of.empty() ? "" : " " + candidates.of);
    case Kind::parameters:
      return " _sphverify_parameters";
    case Kind::nothing:
      break;
  }
  return " ";
}

/// What a value is called beside the offers.
std::string message_of(OptionFacts const& option) {
  if (words_of(option).empty()) return escaped(option.takes);
  std::string const& name = option.names.back();
  return name.substr(std::min(name.find_first_not_of('-'), name.size()));
}

/// The argument of _arguments for an option.
std::string specification(OptionFacts const& option) {
  std::string const names = fmt::format("{}", fmt::join(option.names, ","));
  std::string const value =
      option.takes.empty() ? "" : fmt::format(":{}:{}", message_of(option), action_of(option));
  bool const ends = option.names.back() == "--help" || option.names.back() == "--version";
  bool const repeats = option.is_list || option.may_be_repeated;
  std::string const others = ends      ? "(- *)"
                             : repeats ? ""
                                       : fmt::format("({})", fmt::join(option.names, " "));
  std::string const spelt = option.names.size() > 1 ? fmt::format("'{{{}}}'", names) : names;
  return fmt::format("'{}{}{}[{}]{}'", others, repeats ? "*" : "", spelt, escaped(option.says), value);
}

std::string arguments(CLI::App const& command) {
  std::string text = "      _arguments -s";
  for (OptionFacts const& one : options_of(command)) text += " \\\n        " + specification(one);
  int place = 0;
  for (OptionFacts const& one : arguments_of(command)) {
    std::string const where = one.is_list ? "*" : std::to_string(++place);
    text += fmt::format(" \\\n        '{}:{}:{}'", where, message_of(one), action_of(one));
  }
  return text + "\n";
}

}  // namespace

std::string zsh_completion(CLI::App const& app) {
  std::string commands, cases;
  for (CLI::App const* command : app.get_subcommands({})) {
    commands += fmt::format("    '{}:{}'\n", command->get_name(), escaped(command->get_description()));
    cases += fmt::format("    {})\n{}      ;;\n", command->get_name(), arguments(*command));
  }
  std::string text = head;
  text += "_sphverify_commands() {\n  local -a commands=(\n" + commands +
          "  )\n  _describe -t commands command commands\n}\n\n";
  text +=
      "_sphverify() {\n  local program=${words[1]/#\\~\\//$HOME/} curcontext=$curcontext state state_descr "
      "line\n  typeset -A opt_args\n  _arguments -C";
  for (OptionFacts const& one : options_of(app)) text += " \\\n    " + specification(one);
  text += " \\\n    '1: :_sphverify_commands' '*:: :->rest' && return\n";
  text += "  case $line[1] in\n" + cases + "  esac\n}\n\n_sphverify \"$@\"\n";
  return text;
}

}  // namespace sphverify
