// SPDX-License-Identifier: GPL-3.0-or-later
#include <malloc.h>

#include <limits>
#include <memory>

#include "harness/cli/commands.hpp"
#include "harness/cli/option_facts.hpp"
#include "harness/codes/assess.hpp"
#include "harness/study/say.hpp"
#include "reports/json/results_json.hpp"
#include "reports/write_results.hpp"

namespace sphverify {

namespace {

struct AssessCommand {
  std::string document, output = "-", format = "json";
};

void run(AssessCommand const& command) {
  ResultsFormat const format = results_format(command.format, "assess");
  // Lists of all particles come and go one after the other. Kept by the process, rather than given back to the system and
  // cleared anew each time, ten million take half the time.
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  require_writable(command.output, command.document);
  Json const json = read_json_file(command.document);
  Results const results = assess(Node(json, command.document), command.output);
  write_results(command.output, results, format);
  say_how_it_went(results.runs);
}

}  // namespace

void add_assess(CLI::App& app) {
  auto command = std::make_shared<AssessCommand>();
  CLI::App* sub = app.add_subcommand("assess", "Measures what another code computed of a case, from its snapshots");
  sub->add_option("SNAPSHOTS.json", command->document, "Which files are of which resolution and time; - for standard input")
      ->required();
  sub->add_option("-o,--output", command->output, "Where the results go; standard output by default")->type_name("FILE");
  take_results_format(*sub, command->format);
  sub->footer(
      "Reads CSV, and the HDF5 of SWIFT, Gadget, GIZMO and PySPH. The results go into compare, gate and report like those of a "
      "study, alone or beside them.\n"
      "Example: sphverify assess snapshots.json -o results.json");
  sub->callback([command] { run(*command); });
}

}  // namespace sphverify
