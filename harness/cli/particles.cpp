// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <memory>

#include "cases/exact/require.hpp"
#include "harness/cli/case_parameters.hpp"
#include "harness/cli/commands.hpp"
#include "harness/cli/option_facts.hpp"
#include "harness/codes/initial_snapshot.hpp"
#include "harness/codes/snapshot_options.hpp"
#include "harness/scene/choices.hpp"
#include "harness/study/memory.hpp"
#include "harness/study/available_memory.hpp"
#include "harness/study/parameter_complaint.hpp"
#include "harness/study/read_case.hpp"
#include "harness/study/read_envelope.hpp"
#include "harness/study/read_layout.hpp"
#include "reports/json/parse.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

struct ParticlesCommand {
  std::string case_id, layout = "lattice", kernel = "cubic-spline", format = "csv", output;
  std::vector<std::string> parameters;
  std::int64_t resolution = 0;
  double smoothing_ratio = 1.2;
};

constexpr double bytes_per_particle = 400.0;  // of all columns, and the text that they become

LayoutChoice layout_named(std::string const& text) {
  auto const parsed = parse_json(text);
  Json const value = parsed && parsed->is_object() ? *parsed : Json(text);
  auto const layouts = read_layout(Node(value, "particles", "--layout"));
  if (layouts.size() > 1) throw UserError("particles", "--layout", "several seeds", "one");
  return layouts.front();
}

void write_particles(ParticlesCommand const& command) {
  require_writable(command.output);
  if (command.output == "-" && command.format != "csv")
    throw UserError("particles", "--output", "-", "a file: only CSV goes to standard output");
  Case const& one = case_named("particles", command.case_id);
  Parameters parameters = read_assignments("particles", one.info, command.parameters);
  std::string const place = "particles: " + one.info.id;
  Discretisation d;
  d.kernel = command.kernel;
  d.layout = layout_named(command.layout);
  Json const ratio = command.smoothing_ratio;
  d.smoothing_ratio = read_smoothing_ratio(Node(ratio, "particles", "--smoothing-ratio"));
  int const resolution = static_cast<int>(command.resolution);
  try {
    parameters = sensible(one, parameters);
    AnyProblem const problem = one.problem(parameters);
    std::visit(
        [&](auto const& p) {
          if (!p.not_run_because.empty()) throw UserError(place, "CASE", p.not_run_because, "a case that particles run");
        },
        problem);
    if (std::string const why = why_not(problem, d.layout); !why.empty())
      throw UserError(place, "--layout", why, "one that the case can have");
    double const bytes = bytes_per_particle * estimated_particles(problem, d.layout, resolution);
    if (bytes > available_memory())
      throw UserError(place, "--resolution", fmt::format("{}, which takes about {:.3g} GB", resolution, 1e-9 * bytes),
                      fmt::format("what fits into {:.3g} GB", 1e-9 * available_memory()));
    Snapshot const snapshot = initial_snapshot(one.info.kind, problem, d, resolution, d.smoothing_ratio);
    write_initial_particles(command.output, command.format, snapshot, problem, d);
    if (command.output == "-") return;
    Json sheet = case_sheet(one, parameters, problem, d, resolution, d.smoothing_ratio);
    sheet["particles"] = snapshot.size();
    sheet["format"] = command.format;
    std::string const beside = command.output + ".case.json";
    write_document(beside, document_text(sheet));
    fmt::print(stderr, "{} particles in {}; walls, domain and times in {}\n", snapshot.size(), command.output, beside);
  } catch (BadValue const& error) {
    Json const values = assigned_values(command.parameters);
    throw parameter_complaint(error, one.info, place, "--parameter ", &values);
  } catch (std::invalid_argument const& error) {
    throw UserError(place, "--parameter", error.what(), "values for which the case has a solution");
  }
}

}  // namespace

void add_particles(CLI::App& app) {
  auto command = std::make_shared<ParticlesCommand>();
  CLI::App* sub = app.add_subcommand("particles", "Writes a case's initial particles for another code");
  sub->add_option("CASE", command->case_id, "A case from `sphverify list cases`")->required();
  sub->add_option("-p,--parameter", command->parameters, "VALUE is JSON or a bare word")
      ->take_all()
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  sub->add_option("-n,--resolution", command->resolution, "Particles along the first axis")
      ->required()
      ->check(CLI::Range(1, 100'000'000))
      ->type_name("N");
  sub->add_option("--layout", command->layout, "A word, or JSON such as {\"id\": \"glass\", \"seed\": 1} [lattice]")->type_name("LAYOUT");
  sub->add_option("--smoothing-ratio", command->smoothing_ratio, "h/dx, of the kernel below [1.2]")->type_name("RATIO");
  sub->add_option("--kernel", command->kernel, "Whose support h is for [cubic-spline]")
      ->check(one_of_words(kernel_words()))
      ->type_name("KERNEL");
  take_one_of(sub->add_option("--format", command->format, "How they are written [csv]"), initial_formats);
  sub->add_option("-o,--output", command->output, "The file; - for standard output")->required()->type_name("FILE");
  sub->footer(
      "FILE.case.json, beside it, says domain, walls and what they prescribe, final time and parameters.\n"
      "Example: sphverify particles hydro/riemann --resolution 100 -o sod.csv");
  sub->callback([command] { write_particles(*command); });
}

}  // namespace sphverify
