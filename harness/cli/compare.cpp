// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/ranges.h>
#include <unistd.h>

#include <memory>
#include <set>
#include <utility>

#include "harness/cli/commands.hpp"
#include "harness/cli/controls.hpp"
#include "harness/cli/option_facts.hpp"
#include "harness/terminal.hpp"
#include "reports/json/results_json.hpp"
#include "reports/table/compare.hpp"
#include "reports/table/document_names.hpp"
#include "reports/table/sections.hpp"

namespace sphverify {

namespace {

struct CompareCommand {
  std::vector<std::string> documents;
  std::string format = "table";
  CompareOptions options;
};

/// The option of errors that is given, with its value; empty words where none is.
std::pair<std::string, std::string> choice_of_errors(CompareOptions const& options) {
  if (options.region != CompareOptions{}.region) return {"--region", options.region};
  if (!options.norm.empty()) return {"--norm", options.norm};
  return {};
}

/// Refuses a region that no series has: its tables would be empty.
void require_region(CompareOptions const& options, std::vector<NamedResults> const& documents) {
  std::set<std::string> known;
  for (NamedResults const& document : documents) {
    for (Series const& series : document.results.series) {
      for (OrderEntry const& order : series.orders) known.insert(order.region);
    }
  }
  auto const [option, value] = choice_of_errors(options);
  if (known.empty() && !option.empty())
    throw UserError("compare", option, value, "none: these documents hold no ladder of errors");
  if (!known.empty() && !known.contains(options.region))
    throw UserError("compare", "--region", options.region, fmt::format("one of {}", fmt::join(known, ", ")));
}

/// Refuses options that the section, or the format, would pass over.
void require_used(CompareCommand const& command) {
  CompareOptions const& options = command.options;
  bool const is_text = command.format == "table" || command.format == "markdown";
  if (options.legend && !is_text)
    throw UserError("compare", "--legend", "--format " + command.format, "table or markdown");
  auto const [option, value] = choice_of_errors(options);
  for (Section const& section : sections()) {
    if (section.name != options.section) continue;
    if (!option.empty() && !section.own_errors.empty())
      throw UserError("compare", option, value + " with --section " + section.name,
                      "none: " + section.own_errors);
    if (options.legend && section.legend().empty())
      throw UserError("compare", "--legend", "--section " + section.name, "a section with marks to explain");
  }
}

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  for (Section const& section : sections()) names.push_back(section.name);
  return names;
}

/// "summary: ...", a line each.
std::string section_help() {
  std::string text = "One part alone; default: all but levels, of csv series";
  for (Section const& section : sections()) text += fmt::format("\n{}: {}", section.name, section.says);
  return text;
}

void compare_documents(CompareCommand const& command) {
  require_used(command);
  if (command.options.section == "changes" && command.documents.size() < 2)
    throw UserError("compare", "--section", "changes of one document", "two documents or more");
  std::vector<std::string> const names = document_names(command.documents);
  std::vector<NamedResults> documents;
  for (std::size_t k = 0; k < names.size(); ++k)
    documents.push_back({names[k], read_whole_results(command.documents[k])});
  require_region(command.options, documents);
  CompareOptions options = command.options;
  options.style.format = command.format == "markdown" ? TableFormat::markdown
                         : command.format == "csv"    ? TableFormat::csv
                         : command.format == "json"   ? TableFormat::json
                                                      : TableFormat::table;
  options.style.colour = options.style.format == TableFormat::table && takes_colour(STDOUT_FILENO);
  options.style.columns = known_columns().value_or(usual_columns);
  options.controls = control_ids();
  write_document("-", compare(documents, options));
}

}  // namespace

void add_compare(CLI::App& app) {
  auto command = std::make_shared<CompareCommand>();
  CLI::App* sub =
      app.add_subcommand("compare", "Formulations side by side, from one or more results documents");
  sub->add_option("RESULTS.json", command->documents, "Results documents")->required();
  take_one_of(sub->add_option("--section", command->options.section, section_help()), section_names());
  take_one_of(sub->add_option("--format", command->format, "How they are written [table]"), {"table", "markdown", "csv", "json"});
  take_one_of(sub->add_option("--region", command->options.region, "Where errors are taken [all]"),
              {"all", "interior", "wall", "corner", "smooth"});
  take_one_of(sub->add_option("--norm", command->options.norm, "Of errors; default: l1 where the solution jumps, l2 elsewhere"),
              {"l1", "l2", "linf"});
  sub->add_flag("--legend", command->options.legend, "Says below the tables what their marks mean");
  sub->footer(
      "Lines are as long as COLUMNS or the terminal says, else 80.\n"
      "Example: sphverify compare results.json --region wall --norm linf\n"
      "         sphverify compare results.json --section levels --format csv > levels.csv\n"
      "         sphverify compare before.json after.json --section changes");
  sub->callback([command] { compare_documents(*command); });
}

}  // namespace sphverify
