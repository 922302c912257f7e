// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <memory>

#include "harness/cli/commands.hpp"
#include "harness/gate/judge.hpp"
#include "harness/gate/read_gates.hpp"
#include "harness/gate/rebaseline.hpp"
#include "harness/gate/write_verdicts.hpp"
#include "harness/terminal.hpp"
#include "reports/json/results_json.hpp"
#include "reports/write_results.hpp"

namespace sphverify {

namespace {

struct GateCommand {
  std::string results, gates;
  std::string junit, markdown;
  bool rebaseline = false;
};

std::string environment(char const* name) {
  char const* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// A report goes to a file: standard output holds the lines.
void require_report_file(GateCommand const& command, std::string const& path, char const* option) {
  if (path == "-") throw UserError("gate", option, "'-'", "a file");
  require_writable(path, command.results);
  require_writable(path, command.gates);
}

/// The runner's own summary page; earlier steps have written to it.
void append(std::string const& path, std::string const& text) {
  std::ofstream file(path, std::ios::binary | std::ios::app);
  file << text << std::flush;
  if (!file) throw UserError("GITHUB_STEP_SUMMARY", "", "'" + path + "'", "a file that can be appended to");
}

void rebaseline(Gates const& gates, GateCommand const& command) {
  Results const results = read_whole_results(command.results);
  Rebaseline const plan = plan_rebaseline(gates, results, command.results);
  write_document("-", rebaseline_text(plan));
  for (std::string const& path : plan.paths) {
    write_results(path, results, format_of_file(path));
    write_document("-", "written: " + path + "\n");
  }
}

void gate(GateCommand const& command) {
  if (command.results == "-" && command.gates == "-")
    throw UserError("gate", "", "standard input twice", "at most one document from standard input");
  Json const document = read_json_file(command.gates);
  Gates const gates = read_gates(Node(document, command.gates));
  if (command.rebaseline) return rebaseline(gates, command);

  if (!command.junit.empty()) require_report_file(command, command.junit, "--junit");
  if (!command.markdown.empty()) require_report_file(command, command.markdown, "--markdown");
  Results const results = read_whole_results(command.results);
  auto const verdicts = judge(gates, results, read_baselines(gates, command.results));

  if (std::string const summary = environment("GITHUB_STEP_SUMMARY"); !summary.empty())
    append(summary, verdicts_markdown(gates, verdicts) + "\n");
  if (!command.junit.empty()) write_document(command.junit, verdicts_junit(gates, verdicts));
  if (!command.markdown.empty()) write_document(command.markdown, verdicts_markdown(gates, verdicts));
  std::string text = environment("GITHUB_ACTIONS") == "true" ? verdicts_annotations(gates, verdicts) : "";
  text += verdicts_text(verdicts, takes_colour(STDOUT_FILENO), known_columns().value_or(widest_line));
  write_document("-", text);
  for (GateVerdict const& one : verdicts) {
    if (!holds(one.verdict)) throw GateFailed();
  }
}

}  // namespace

void add_gate(CLI::App& app) {
  auto command = std::make_shared<GateCommand>();
  CLI::App* sub = app.add_subcommand("gate", "Judges results against limits; exit status 1 if one fails");
  sub->add_option("RESULTS.json", command->results, "Results document; - for standard input")->required();
  sub->add_option("GATES.json", command->gates, "Gates document; - for standard input")->required();
  auto* junit =
      sub->add_option("--junit", command->junit, "Writes the verdicts as JUnit XML")->type_name("FILE");
  auto* markdown =
      sub->add_option("--markdown", command->markdown, "Writes a summary in Markdown")->type_name("FILE");
  sub->add_flag("--rebaseline", command->rebaseline,
                "Judges nothing: prints old, new and difference of every gate that has "
                "a baseline, then overwrites the baseline files with RESULTS.json")
      ->excludes(junit)
      ->excludes(markdown);
  sub->footer(
      "One line per gate: verdict, name, measured, limit. Where GITHUB_ACTIONS is true, failures are "
      "annotated; a summary is appended to the file that GITHUB_STEP_SUMMARY names.\n"
      "Example: sphverify gate results.json gates.json --junit gates.xml");
  sub->callback([command] { gate(*command); });
}

}  // namespace sphverify
