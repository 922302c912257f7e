// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "harness/cli/commands.hpp"
#include "harness/cli/option_facts.hpp"
#include "harness/study/merge.hpp"
#include "harness/study/say.hpp"
#include "reports/json/results_json.hpp"
#include "reports/write_results.hpp"

namespace sphverify {

namespace {

struct MergeCommand {
  std::vector<std::string> parts;
  std::string output = "-";
  std::string format = "json";
  std::string missing;
};

void merge(MergeCommand const& command) {
  ResultsFormat const format = results_format(command.format, "merge");
  std::vector<NamedPart> parts;
  for (std::string const& file : command.parts) {
    require_writable(command.output, file);
    if (!command.missing.empty()) require_writable(command.missing, file);
    if (std::any_of(parts.begin(), parts.end(), [&](NamedPart const& known) { return known.file == file; }))
      throw UserError("merge", "PART.json", file + " twice", "every part once");
    parts.push_back({file, read_results(file)});
  }
  Merged const merged = merge_parts(std::move(parts));
  if (merged.missing.empty()) {
    write_results(command.output, merged.results, format);
    say_how_it_went(merged.results.runs);
    return;
  }
  if (!command.missing.empty()) write_document(command.missing, document_text(to_json(merged.rest)));
  throw UserError("merge", "runs", fmt::format("no run {}", merged.missing_text),
                  command.missing.empty() ? "all runs of the study; --missing REST.json writes the study of these alone"
                                          : "all runs of the study; " + command.missing + " is the study of these alone");
}

}  // namespace

void add_merge(CLI::App& app) {
  auto command = std::make_shared<MergeCommand>();
  CLI::App* sub = app.add_subcommand("merge", "Puts the parts of a study together, with orders over all of them");
  sub->add_option("PART.json", command->parts, "Results of `study --part K/M`, all parts of one study")->required();
  sub->add_option("-o,--output", command->output, "Where the results go; standard output by default")->type_name("FILE");
  take_results_format(*sub, command->format);
  sub->add_option("--missing", command->missing, "Where the study of the runs goes that no part has; its results are a part, too")
      ->type_name("FILE");
  sub->footer(
      "Parts must be of this build of the program. Times of two machines are never compared.\n"
      "Example: sphverify merge part-*.json -o results.json");
  sub->callback([command] { merge(*command); });
}

}  // namespace sphverify
