// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <memory>

#include "cases/support/case.hpp"
#include "harness/cli/commands.hpp"
#include "harness/codes/external_code.hpp"
#include "harness/study/expand.hpp"
#include "reports/agreement.hpp"
#include "reports/json/results_json.hpp"
#include "reports/printable.hpp"

namespace sphverify {

namespace {

struct RepeatCommand {
  std::string document;
  std::int64_t run = 0;
  std::string output = "-";
};

/// Of a run's recorded parameters those that its case looks at: earlier versions recorded the others, too.
Json used_parameters(RunRecord const& run) {
  Case const* const found = find_case(run.case_id);
  if (found == nullptr) return parameters_json(run.parameters);  // reading the study says so
  Parameters parameters(found->info.parameters);
  for (auto const& [name, value] : run.parameters) parameters.set(name, value);
  try {
    return parameters_json(in_use(*found, parameters).all());
  } catch (std::exception const&) {
    return parameters_json(run.parameters);  // likewise
  }
}

/// The study whose last run is the one, measured and bounded as the whole was.
Study study_of(Node const& whole, RunRecord const& run) {
  Json const record = to_json(run);
  Json formulation = {{"id", record.at("formulation")}, {"walls", record.at("walls")}};
  for (char const* partner : {"work", "conduction"}) {
    if (!record.at(partner).is_null()) formulation[partner] = record.at(partner);
  }
  for (Node const& one : whole.at("formulations").one_or_many()) {
    // A code that is not ours is what the study says of it.
    if (is_external(run.formulation.id) && one.is_object() && one.at("id").json() == run.formulation.id) formulation = one.json();
  }
  Json discretisation = record.at("discretisation");
  for (auto it = discretisation.begin(); it != discretisation.end();) {
    it = it->is_null() ? discretisation.erase(it) : std::next(it);
  }
  // The refinement path starts at the study's coarsest level, which stands beside the run.
  Json resolutions = Json::array({whole.at("resolution").one_or_many().front().json()});
  if (resolutions.front() != run.resolution) resolutions.push_back(run.resolution);
  Json document = {
      {"schema", "sphverify-study/1"},
      {"name", whole.at("name").json()},
      {"cases", Json::array({{{"id", record.at("case")}, {"parameters", used_parameters(run)}}})},
      {"formulations", Json::array({formulation})},
      {"discretisation", discretisation},
      {"resolution", resolutions},
      {"smoothing_exponent", run.smoothing_exponent},
      {"measure", whole.at("measure").json()},
      {"threads", whole.at("threads").json()},
      {"repeat", whole.at("repeat").json()},
      {"time_budget", whole.at("time_budget").json()}};
  if (auto const plugins = whole.find("plugins")) document["plugins"] = plugins->json();
  Node const node(document, whole.file());
  Study study = read_study(node);
  require_memory(study, node);
  return study;
}

void repeat(RepeatCommand const& command) {
  require_writable(command.output, command.document);
  Results const results = read_results(command.document);
  if (results.runs.empty())
    throw UserError(command.document, "runs", "an empty list", "a document of a study that ran something");
  if (command.run < 0 || command.run >= static_cast<std::int64_t>(results.runs.size())) {
    throw UserError(command.document, "RUN", std::to_string(command.run),
                    fmt::format("an index from 0 to {}", results.runs.size() - 1));
  }
  Json const of_all = Json::parse(results.study);
  Node const whole(of_all, command.document, "study");
  if (whole.at("schema").json() == "sphverify-snapshots/1")
    throw UserError(command.document, "study", "snapshots of another code", "a study, whose runs can be carried out again");
  whole.require_schema("sphverify-study/1");
  RunRecord const& before = results.runs[static_cast<std::size_t>(command.run)];
  Study const study = study_of(whole, before);
  Expansion const expansion = expand(study);
  if (expansion.runs.empty()) {
    throw UserError(command.document + ": run " + std::to_string(command.run) + ": " +
                    expansion.skipped.front().reason);
  }
  RunRecord const now = execute(expansion.runs.back(), {.measure = study.measure,
                                                        .threads = study.threads,
                                                        .repeat = study.repeat,
                                                        .time_budget = study.time_budget,
                                                        .interrupted = nullptr});
  auto const said = [](RunRecord const& run) {
    return run.reason.empty() ? run.status : run.status + ": " + printable(run.reason);
  };
  fmt::print(stderr, "run {}: {} on {}\n  recorded  {}\n  now       {}\n  numbers   {}\n", command.run,
             printable(now.label), now.case_id, said(before), said(now),
             agreement_text(agreement(before, now)));
  write_document(command.output, document_text(to_json(now)));
}

}  // namespace

void add_repeat(CLI::App& app) {
  auto command = std::make_shared<RepeatCommand>();
  CLI::App* sub = app.add_subcommand("repeat", "Carries out one run of a results document again");
  sub->add_option("RESULTS.json", command->document, "The results document")->required();
  sub->add_option("RUN", command->run, "Which of its runs, counted from 0")->required();
  sub->add_option("-o,--output", command->output, "Where the run's record goes; standard output by default")->type_name("FILE");
  sub->footer(
      "Says on standard error how the run ended then and now, and how its numbers but the times agree: "
      "to the bit with the same build and machine. Exit status 0 either way.\n"
      "Example: sphverify repeat results.json 17 -o run.json");
  sub->callback([command] { repeat(*command); });
}

}  // namespace sphverify
