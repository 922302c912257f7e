// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <sstream>
#include <vector>

#include "harness/cli/commands.hpp"
#include "harness/cli/help.hpp"
#include "harness/cli/option_facts.hpp"
#include "harness/cli/shell/shell_files.hpp"
#include "harness/study/context.hpp"
#include "reports/table/number_text.hpp"

namespace sphverify {

namespace {

constexpr std::size_t source_columns = 76;   // of the page's source, for whoever reads it
constexpr std::size_t example_columns = 72;  // of a line as it is shown, behind the page's margin
constexpr std::string_view example = "Example: ";

/// One line as roff takes it literally.
std::string escaped(std::string_view line) {
  std::string text;
  if (line.starts_with('.')) text += "\\&";
  for (char const c : line) {
    switch (c) {
      case '\\':
        text += "\\e";
        break;
      case '-':
        text += "\\-";
        break;
      case '\'':
        text += "\\(aq";
        break;
      case '`':
        text += "\\(ga";
        break;
      case '^':
        text += "\\(ha";
        break;
      case '~':
        text += "\\(ti";
        break;
      default:
        text += c;
    }
  }
  return text;
}

/// A paragraph, in short lines. What stands between backquotes is bold.
std::string prose(std::string const& words) {
  std::string text;
  bool is_bold = false;
  for (std::string const& line : lines_of_words(words, source_columns)) {
    std::string out;
    for (std::size_t from = 0; from <= line.size();) {
      std::size_t const to = std::min(line.find('`', from), line.size());
      out += escaped(std::string_view(line).substr(from, to - from));
      if (to == line.size()) break;
      is_bold = !is_bold;
      out += is_bold ? "\\fB" : "\\fR";
      from = to + 1;
    }
    text += out + "\n";
  }
  return text;
}

std::string section(std::string const& title) { return ".SH " + title + "\n"; }

std::string bold(std::string_view text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string slanted(std::string_view text) { return "\\fI" + escaped(text) + "\\fR"; }

/// A term and what it means; further lines of the meaning are paragraphs of their own.
std::string entry(std::string const& term, std::string const& meaning) {
  std::string text = ".TP\n" + term + "\n";
  std::istringstream lines(meaning);
  bool is_first = true;
  for (std::string line; std::getline(lines, line); is_first = false)
    text += (is_first ? "" : ".br\n") + prose(line);
  return text;
}

std::string term_of(OptionFacts const& option) {
  if (option.is_positional) return slanted(option.head());
  std::string text;
  for (std::string const& name : option.names) text += (text.empty() ? "" : ", ") + bold(name);
  if (option.takes.empty()) return text;
  return text + " " + (words_of(option).empty() ? slanted(option.takes) : bold(option.takes)) +
         (option.is_list ? "..." : "");
}

std::string entries(std::string const& title, std::vector<OptionFacts> const& options) {
  if (options.empty()) return "";
  std::string text = section(title);
  for (OptionFacts const& one : options)
    text += entry(term_of(one), one.says + (one.is_required && !one.is_positional ? "; required" : ""));
  return text;
}

struct Footer {
  std::vector<std::string> notes, examples;
};

Footer footer_of(CLI::App const& command) {
  Footer footer;
  std::istringstream lines(command.get_footer());
  for (std::string line; std::getline(lines, line);) {
    if (line == "Examples:" || line.starts_with("Exit status:")) continue;  // sections of their own
    if (line.starts_with(example)) {
      footer.examples.push_back(line.substr(example.size()));
    } else if (line.starts_with(' ')) {
      footer.examples.push_back(line.substr(line.find_first_not_of(' ')));
    } else {
      footer.notes.push_back(line);
    }
  }
  return footer;
}

std::string paragraphs(std::vector<std::string> const& notes) {
  std::string text;
  for (std::string const& note : notes) text += (text.empty() ? "" : ".PP\n") + prose(note);
  return text;
}

std::string examples(std::vector<std::string> const& commands) {
  std::string text = section("EXAMPLES") + ".EX\n";
  for (std::string const& one : commands) {
    std::istringstream lines(command_lines(one, 0, example_columns));
    for (std::string line; std::getline(lines, line);) text += escaped(line) + "\n";
  }
  return text + ".EE\n";
}

struct Described {
  std::string name, meaning;
};

std::string exit_status() {
  std::string text = section("EXIT STATUS");
  for (auto const& [status, meaning] : std::array<std::pair<int, char const*>, 4>{
           {{exit_done, "Done."},
            {exit_gate_failed,
             "A gate failed; of `claims`, a claim; of `evaluate --against`, a rate. Everything was carried "
             "out."},
            {exit_user_error,
             "The input is wrong: one line on standard error says file, line, column and key, what was found "
             "and "
             "what was expected."},
            {exit_program_error, "The program or the machine failed, or the program was interrupted."}}})
    text += entry(bold(std::to_string(status)), meaning);
  return text;
}

std::string environment() {
  // Each variable that the sources read is named here: a test looks for them.
  std::string const rank = "Set by `mpirun`, `srun` and their like: which of how many ranks this process is.";
  std::string const job = "Set by them as well: which job it is, so that the ranks of one find each other.";
  std::vector<Described> const all{
      {"COLUMNS",
       "How many columns lines of help and tables have. Otherwise as many as the terminal, or 80. At least "
       "40."},
      {"NO_COLOR", "If it is set, and not empty, nothing is coloured."},
      {"TERM",
       "On a terminal that is `dumb` nothing is coloured, and progress is said in lines, as in a log."},
      {"SOURCE_DATE_EPOCH",
       "The date that results documents bear, in seconds since 1970, in place of the clock's; see "
       "https://reproducible-builds.org."},
      {"SPHVERIFY_RANKS",
       "If it is `off`, processes that `mpirun` or `srun` started are studies of their own and share no "
       "runs."},
      {"OMPI_COMM_WORLD_RANK, OMPI_COMM_WORLD_SIZE, PMI_RANK, PMI_SIZE, SLURM_PROCID, SLURM_STEP_NUM_TASKS",
       rank},
      {"PMIX_NAMESPACE, OMPI_MCA_ess_base_jobid, PMI_JOBID, SLURM_JOB_ID, SLURM_STEP_ID, SLURM_RESTART_COUNT",
       job},
      {"TMPDIR", "The folder in which codes that a study starts are run; otherwise /tmp."},
      {"GITHUB_ACTIONS", "If it is `true`, `gate` annotates what fails."},
      {"GITHUB_STEP_SUMMARY", "The file to which `gate` appends its summary."}};
  std::string text = section("ENVIRONMENT");
  for (Described const& one : all) text += entry(bold(one.name), one.meaning);
  return text + ".PP\n" +
         prose(
             "A code that a study starts finds `OMP_NUM_THREADS`, the threads that it may use, and "
             "`SPHVERIFY_RUN`, by "
             "which what it leaves running is found and ended.");
}

std::string files() {
  std::vector<Described> const all{
      {"RESULTS.json.journal",
       "The finished runs of a study, until its results are written; `study --resume` takes it up."},
      {"RESULTS.json.journal.old", "What a study found there that started afresh."},
      {"RESULTS.json.ranks", "Where the ranks of a study meet while it runs."},
      {"FILE.case.json",
       "Beside the particles that `particles` writes: domain, walls, times and parameters of the case."},
      {"PREFIX/share/sphverify/studies, PREFIX/share/sphverify/schema",
       "Ready-made studies, and the schemas of all documents, with every key explained. PREFIX is where the "
       "program was installed."}};
  std::string text = section("FILES");
  for (Described const& one : all) text += entry(slanted(one.name), one.meaning);
  return text;
}

std::string head(std::string const& name, std::string const& says) {
  Context const build = build_context();
  std::string upper = name;
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return fmt::format(
      ".\\\" Made by the build from the program's own help.\n"
      ".TH {} 1 \"{}\" \"sphverify {}\" \"User Commands\"\n"
      "{}{} \\- {}\n",
      escaped(upper), build_date(), build.version, section("NAME"), escaped(name), escaped(says));
}

std::string synopsis(CLI::App const& command, std::string const& typed) {
  std::string const usage = usage_of(command, typed);
  return section("SYNOPSIS") + bold(typed) + escaped(usage.substr(typed.size())) + "\n";
}

std::string see_also(std::vector<std::string> const& pages) {
  std::string text = section("SEE ALSO");
  for (std::size_t k = 0; k < pages.size(); ++k)
    text += fmt::format(".BR {} (1){}\n", escaped(pages[k]), k + 1 < pages.size() ? "," : "");
  return text;
}

std::string page_of_program(CLI::App const& app) {
  std::string text =
      head("sphverify", "find out which formulation of smoothed particle hydrodynamics to trust");
  text += synopsis(app, "sphverify");
  text += section("DESCRIPTION") + prose(app.get_description());
  text += ".PP\n" + prose(
                        "A `study` runs every combination of cases, formulations and resolutions that a JSON "
                        "document names, and "
                        "writes one results document; `compare` and `report` show it, `gate` judges it.");
  text += section("COMMANDS");
  std::vector<std::string> pages;
  for (CLI::App const* command : app.get_subcommands({})) {
    text += entry(bold(command->get_name()), command->get_description());
    pages.push_back("sphverify-" + command->get_name());
  }
  text += entries("OPTIONS", options_of(app)) + exit_status() + environment() + files() +
          examples(footer_of(app).examples);
  return text + see_also(pages);
}

std::string page_of_command(CLI::App const& command) {
  std::string const name = command.get_name();
  std::string says = command.get_description();
  says.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(says.front())));
  Footer const footer = footer_of(command);
  std::string text = head("sphverify-" + name, says) + synopsis(command, "sphverify " + name);
  if (!footer.notes.empty()) text += section("DESCRIPTION") + paragraphs(footer.notes);
  text += entries("ARGUMENTS", arguments_of(command)) + entries("OPTIONS", options_of(command)) +
          exit_status() + examples(footer.examples);
  return text + see_also({"sphverify"});
}

}  // namespace

std::string manual_page(CLI::App const& command) {
  return command.get_parent() == nullptr ? page_of_program(command) : page_of_command(command);
}

}  // namespace sphverify
