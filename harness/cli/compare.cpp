#include <fmt/ranges.h>
#include <unistd.h>

#include <memory>
#include <set>

#include "harness/cli/commands.hpp"
#include "harness/cli/controls.hpp"
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

/// Refuses a region that no series has: its tables would be empty.
void require_region(std::string const& region, std::vector<NamedResults> const& documents) {
  std::set<std::string> known;
  for (NamedResults const& document : documents) {
    for (Series const& series : document.results.series) {
      for (OrderEntry const& order : series.orders) known.insert(order.region);
    }
  }
  if (!known.empty() && !known.contains(region))
    throw UserError("compare", "--region", region, fmt::format("one of {}", fmt::join(known, ", ")));
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
  if (command.options.section == "changes" && command.documents.size() < 2)
    throw UserError("compare", "--section", "changes of one document", "two documents or more");
  std::vector<std::string> const names = document_names(command.documents);
  std::vector<NamedResults> documents;
  for (std::size_t k = 0; k < names.size(); ++k)
    documents.push_back({names[k], read_results(command.documents[k])});
  require_region(command.options.region, documents);
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
  sub->add_option("--format", command->format, "table, markdown, csv or json")
      ->check(CLI::IsMember({"table", "markdown", "csv", "json"}));
  sub->add_option("--region", command->options.region, "all, interior, wall, corner or smooth")
      ->check(CLI::IsMember({"all", "interior", "wall", "corner", "smooth"}));
  sub->add_option("--norm", command->options.norm,
                  "l1, l2 or linf; default: l1 where the solution jumps, l2 elsewhere")
      ->check(CLI::IsMember({"l1", "l2", "linf"}));
  sub->add_option("--section", command->options.section, section_help())
      ->check(CLI::IsMember(section_names()));
  sub->add_flag("--legend", command->options.legend, "Says below the tables what their marks mean");
  sub->footer(
      "Lines are as long as COLUMNS or the terminal says, else 80.\n"
      "Example: sphverify compare results.json --region wall --norm linf\n"
      "         sphverify compare results.json --section levels --format csv > levels.csv\n"
      "         sphverify compare before.json after.json --section changes");
  sub->callback([command] { compare_documents(*command); });
}

}  // namespace sphverify
