// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/cli/shell/candidates.hpp"
#include "harness/cli/shell/shell_files.hpp"

namespace sphverify {

namespace {

using Kind = Candidates::Kind;

constexpr char const* head =
    R"bash(# Completion of sphverify for bash, made by the build from the program's own options.
# A program with parts of its own is completed likewise, parts included: complete -F _sphverify my-verify

)bash";

constexpr char const* engine = R"bash(
# Offers what begins like $1 of what the other words name.
_sphverify_offer() {
  local typed=$1 program=${COMP_WORDS[0]/#\~\//$HOME/}
  case $2 in
    words) mapfile -t COMPREPLY < <(compgen -W "${*:3}" -- "$typed") ;;
    files)
      compopt -o filenames 2> /dev/null
      if [[ -n $3 ]]; then
        mapfile -t COMPREPLY < <(compgen -f -X "!*.$3" -- "$typed"; compgen -d -- "$typed")
      else
        mapfile -t COMPREPLY < <(compgen -f -- "$typed")
      fi
      ;;
    listed)
      # A line without blanks before it is a heading where everything is listed.
      mapfile -t COMPREPLY < <(compgen -W "$("$program" list ${3:+"$3"} 2> /dev/null |
        if [[ -n $3 ]]; then cut -d ' ' -f 1; else sed -n 's/^  \([^ ]*\).*/\1/p'; fi)" -- "$typed")
      ;;
    parameters)
      [[ $typed == *=* || -z $subject ]] && return
      compopt -o nospace 2> /dev/null
      mapfile -t COMPREPLY < <(compgen -S = -W "$("$program" describe "$subject" 2> /dev/null |
        sed -n '/^parameters$/,/^$/s/^  \([a-z_0-9]*\) .*/\1/p')" -- "$typed")
      ;;
  esac
}

_sphverify() {
  # Bash cuts words at '=': they are put together again.
  local -a words=()
  local k
  for ((k = 1; k <= COMP_CWORD; ++k)); do
    if ((k > 1)) && [[ ${COMP_WORDS[k]} == = || ${COMP_WORDS[k - 1]} == = ]]; then
      words[-1]+=${COMP_WORDS[k]}
    else
      words+=("${COMP_WORDS[k]}")
    fi
  done
  local current=${words[-1]} command='' option='' subject='' takes word
  local -i arguments=0
  unset 'words[-1]'
  for word in "${words[@]}"; do
    if [[ -n $option ]]; then
      option=''
    elif [[ -z $command ]]; then
      [[ $word == -* ]] || command=$word
    elif [[ $word == -?* ]]; then
      _sphverify_takes "$command" "$word"
      [[ $word != *=* && -n $takes ]] && option=$word
    else
      arguments+=1
      [[ -z $subject ]] && subject=$word
    fi
  done
  COMPREPLY=()
  if [[ -n $option ]]; then
    _sphverify_takes "$command" "$option"
  elif [[ $current == --*=* ]]; then
    _sphverify_takes "$command" "${current%%=*}"
    current=${current#*=}
  elif [[ $current == -* || -z $command ]]; then
    takes="words $(_sphverify_options "$command")"
    [[ $current != -* ]] && takes="words $_sphverify_commands"
  else
    _sphverify_takes "$command" $((arguments + 1))
  fi
  _sphverify_offer "$current" $takes
}

complete -F _sphverify sphverify
)bash";

/// As the script's functions take it: "words l1 l2 linf", "files json", "listed cases"; of a flag nothing.
std::string takes(OptionFacts const& option) {
  if (option.takes.empty()) return "";
  Candidates const candidates = candidates_of(option);
  switch (candidates.kind) {
    case Kind::words:
      return fmt::format("words {}", fmt::join(candidates.words, " "));
    case Kind::files:
      return candidates.of.empty() ? "files" : "files " + candidates.of;
    case Kind::listed:
      return candidates.of.empty() ? "listed" : "listed " + candidates.of;
    case Kind::parameters:
      return "parameters";
    case Kind::nothing:
      break;
  }
  return "nothing";
}

std::string names_of(std::vector<OptionFacts> const& options) {
  std::vector<std::string> names;
  for (OptionFacts const& one : options) names.insert(names.end(), one.names.begin(), one.names.end());
  return fmt::format("{}", fmt::join(names, " "));
}

}  // namespace

std::string bash_completion(CLI::App const& app) {
  std::vector<std::string> commands;
  std::string options = fmt::format("    '') echo '{}' ;;\n", names_of(options_of(app)));
  std::string values;
  for (CLI::App const* command : app.get_subcommands({})) {
    std::string const& name = command->get_name();
    commands.push_back(name);
    options += fmt::format("    {}) echo '{}' ;;\n", name, names_of(options_of(*command)));
    for (OptionFacts const& one : options_of(*command)) {
      if (one.takes.empty()) continue;
      std::vector<std::string> patterns;
      for (std::string const& spelling : one.names)
        patterns.push_back(fmt::format("'{} {}'", name, spelling));
      values += fmt::format("    {}) takes='{}' ;;\n", fmt::join(patterns, " | "), takes(one));
    }
    int place = 0;
    for (OptionFacts const& one : arguments_of(*command)) {
      std::string const pattern =
          one.is_list ? fmt::format("'{} '[0-9]*", name) : fmt::format("'{} {}'", name, ++place);
      values += fmt::format("    {}) takes='{}' ;;\n", pattern, takes(one));
    }
  }
  return fmt::format(
             "{}_sphverify_commands='{}'\n\n"
             "# Prints the options of a command.\n"
             "_sphverify_options() {{\n  case $1 in\n{}  esac\n}}\n\n"
             "# Sets `takes` to what an option of a command, or its argument of that number, takes.\n"
             "_sphverify_takes() {{\n  takes=''\n  case \"$1 $2\" in\n{}  esac\n}}\n",
             head, fmt::join(commands, " "), options, values) +
         engine;
}

}  // namespace sphverify
