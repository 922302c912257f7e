#include <unistd.h>

#include <filesystem>
#include <memory>

#include "harness/cli/commands.hpp"
#include "reports/json/results_json.hpp"
#include "reports/table/compare.hpp"

namespace sphverify {

namespace {

struct CompareCommand {
  std::vector<std::string> documents;
  std::string format = "table";
  CompareOptions options;
};

void compare_documents(CompareCommand const& command) {
  std::vector<NamedResults> documents;
  for (std::string const& path : command.documents) {
    documents.push_back({std::filesystem::path(path).stem().string(), read_results(path)});
  }
  CompareOptions options = command.options;
  options.format = command.format == "markdown" ? TableFormat::markdown
                   : command.format == "csv"    ? TableFormat::csv
                   : command.format == "json"   ? TableFormat::json
                                                : TableFormat::table;
  options.colour = options.format == TableFormat::table && isatty(STDOUT_FILENO) != 0;
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
  sub->add_option("--region", command->options.region, "all, interior, wall or corner")
      ->check(CLI::IsMember({"all", "interior", "wall", "corner"}));
  sub->add_option("--norm", command->options.norm,
                  "l1, l2 or linf; default: l1 where the solution jumps, l2 elsewhere")
      ->check(CLI::IsMember({"l1", "l2", "linf"}));
  sub->footer("Example: sphverify compare results.json --region wall --norm linf");
  sub->callback([command] { compare_documents(*command); });
}

}  // namespace sphverify
