// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/cli/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>

#include "harness/cli/commands.hpp"
#include "harness/cli/help.hpp"
#include "harness/gate/gates.hpp"
#include "harness/run/run.hpp"
#include "harness/study/context.hpp"
#include "reports/printable.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

namespace {

int complain(int status, std::string_view message) {
  // Words of the command line and names of files may hold anything.
  fmt::print(stderr, "{}: {}\n", program_name(), printable(std::string(message)));
  return status;
}

/// The library's own message does not name the word.
void require_known_command(CLI::App const& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (CLI::App const* command : app.get_subcommands([](CLI::App const*) { return true; })) {
    names.push_back(command->get_name());
  }
  std::string const found = argv[1];
  if (std::find(names.begin(), names.end(), found) != names.end()) return;
  throw UserError("command", "", "'" + found + "'", one_of(found, names));
}

}  // namespace

std::unique_ptr<CLI::App> command_line(std::string_view program) {
  auto app = std::make_unique<CLI::App>(
      fmt::format("{} runs formulations of smoothed particle hydrodynamics with walls on cases that have "
                  "an exact solution, and reports errors, observed orders, conservation, cost and stability as JSON.",
                  program),
      std::string(program));
  app->formatter(std::make_shared<HelpInColumns>());
  app->footer(
      fmt::format("Examples:\n"
                  "  {0} list formulations\n"
                  "  {0} describe conduction/brookshaw\n"
                  "  {0} study cases/studies/conduction-walls-1d.json -o results.json\n"
                  "  {0} compare results.json\n"
                  "  {0} gate results.json gates.json --junit gates.xml\n"
                  "  {0} report results.json -o report.html\n"
                  "Exit status: 0 done, 1 a gate failed, 2 wrong input, 3 the program or the machine failed.",
                  program));
  app->require_subcommand(1);
  app->set_version_flag("--version", version_text, "Print version, build and licence and exit");
  add_study(*app);
  add_compare(*app);
  add_report(*app);
  add_gate(*app);
  add_list(*app);
  add_describe(*app);
  add_merge(*app);
  add_repeat(*app);
  add_evaluate(*app);
  add_exact(*app);
  add_order(*app);
  add_claims(*app);
  add_particles(*app);
  add_assess(*app);
  return app;
}

int program_main(int argc, char** argv, Program const& program) {
  set_program_name(program.name);
  auto const app = command_line(program.name);

  try {
    if (program.add_parts) program.add_parts();
    require_known_command(*app, argc, argv);
    app->parse(argc, argv);
    return exit_done;
  } catch (CLI::ParseError const& error) {
    if (error.get_exit_code() == 0) return app->exit(error);
    return complain(exit_user_error, fmt::format("{} (see {} --help)", error.what(), program.name));
  } catch (GateFailed const&) {
    return exit_gate_failed;
  } catch (UserError const& error) {
    return complain(exit_user_error, error.what());
  } catch (Interrupted const&) {
    return complain(
        exit_program_error,
        "interrupted; with -o RESULTS.json the finished runs are in its journal: go on with --resume");
  } catch (std::bad_alloc const&) {
    return complain(exit_program_error, "out of memory");
  } catch (std::exception const& error) {
    return complain(exit_program_error, error.what());
  }
}

}  // namespace sphverify
