// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <memory>

#include "harness/cli/commands.hpp"
#include "harness/cli/option_facts.hpp"
#include "harness/study/no_effect.hpp"
#include "harness/study/ranks.hpp"
#include "harness/study/run_study.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

struct StudyCommand {
  std::string document;
  std::string part;
  std::string format = "json";
  StudyOptions options;
};

std::atomic<bool> interrupted{false};

/// The first signal asks the study to stop; the runs in flight notice at their next step.
void stop_on_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = true; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // a second one kills
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGHUP, &action, nullptr);  // the terminal has gone
}

void carry_out_study(StudyCommand const& command) {
  require_writable(command.options.output, command.document);
  StudyOptions options = command.options;
  options.format = results_format(command.format, "study");
  if (!command.part.empty()) options.part = read_part(command.part);
  Json const json = read_json_file(command.document);
  Node const document(json, command.document);
  Study const read = read_study(document);
  require_memory(read, document);
  require_effects(read, document);
  stop_on_signals();
  options.document = command.document;
  options.interrupted = &interrupted;
  run_study(read, options);
}

/// Rank 0 says the same, and is given time to: mpirun ends all ranks as soon as one has failed.
void leave_it_to_rank_0() {
  constexpr unsigned patience = 3;
  if (rank_of_process().number == 0) return;
  fall_silent();
  sleep(patience);  // until a signal, if one comes
}

void study(StudyCommand const& command) {
  try {
    carry_out_study(command);
  } catch (UserError const&) {
    leave_it_to_rank_0();
    throw;
  } catch (Interrupted const&) {
    leave_it_to_rank_0();
    throw;
  }
}

}  // namespace

void add_study(CLI::App& app) {
  auto command = std::make_shared<StudyCommand>();
  CLI::App* sub = app.add_subcommand("study", "Runs every combination of a study document");
  sub->add_option("STUDY.json", command->document, "The study; - for standard input")->required();
  sub->add_option("-o,--output", command->options.output, "Where the results go; standard output by default")->type_name("FILE");
  take_results_format(*sub, command->format);
  sub->add_option("-j,--jobs", command->options.jobs, "Runs at a time, by default one per core; under mpirun or srun of each rank, by default one")
      ->check(CLI::Range(1, 1 << 16))
      ->type_name("N");
  sub->add_flag("--resume", command->options.resume, "Take up the journal that an interrupted study left");
  sub->add_option("--part", command->part, "The K-th of M parts of the runs that take about equally long; `merge` puts them together")
      ->type_name("K/M");
  sub->footer(
      "Finished runs are kept in RESULTS.json.journal until the results are written.\n"
      "Under mpirun or srun the ranks share the runs, and rank 0 writes.\n"
      "Example: sphverify study cases/studies/conduction-walls-1d.json -o results.json");
  sub->callback([command] { study(*command); });
}

}  // namespace sphverify
