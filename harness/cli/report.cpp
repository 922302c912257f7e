// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <memory>

#include "harness/cli/commands.hpp"
#include "harness/cli/controls.hpp"
#include "reports/html/report.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

struct ReportCommand {
  std::vector<std::string> documents;
  std::string output = "-";
};

void report(ReportCommand const& command) {
  std::vector<NamedResults> documents;
  for (std::string const& path : command.documents) {
    require_writable(command.output, path);
    std::string const name = path == "-" ? "results" : std::filesystem::path(path).stem().string();
    documents.push_back({name, read_whole_results(path)});
  }
  write_document(command.output, report_page(documents, control_ids()));
}

}  // namespace

void add_report(CLI::App& app) {
  auto command = std::make_shared<ReportCommand>();
  CLI::App* sub =
      app.add_subcommand("report", "One HTML page with verdicts, plots and tables; needs no network");
  sub->add_option("RESULTS.json", command->documents, "Results documents")->required();
  sub->add_option("-o,--output", command->output, "Where the page goes; standard output by default")->type_name("FILE");
  sub->footer(
      "Several documents are shown one after another; their run times are not compared.\n"
      "Example: sphverify report results.json -o report.html");
  sub->callback([command] { report(*command); });
}

}  // namespace sphverify
