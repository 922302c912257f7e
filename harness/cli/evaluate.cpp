// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/evaluate/evaluate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "formulations/rate_operator.hpp"
#include "harness/cli/commands.hpp"
#include "harness/codes/snapshot.hpp"
#include "harness/evaluate/against.hpp"
#include "harness/gate/gates.hpp"
#include "harness/study/load_plugin.hpp"
#include "reports/json/results_json.hpp"
#include "reports/listed_identifiers.hpp"
#include "reports/printable.hpp"

namespace sphverify {

namespace {

struct EvaluateCommand {
  std::string state, output, against;
  std::vector<std::string> plugins, only;
  double limit = 0.0;  ///< 0: by the precision of the state
};

// Of the largest rate: sums of some hundred terms, some of which nearly cancel.
constexpr double double_limit = 1e-12;
constexpr double single_limit = 64.0 * single_rounding;

void say_remarks(std::string const& file, Json const& rates) {
  if (Json const& open = rates.at("open_towards"); !open.is_null()) {
    fmt::print(stderr, "{}: walls: they do not close: nothing bounds the particles towards {}\n", printable(file),
               open.dump());
  }
  for (Json const& remark : rates.at("remarks"))
    fmt::print(stderr, "{}: particles.smoothing_length: {}\n", printable(file), remark.get<std::string>());
}

std::string text_of(std::vector<double> const& rate) {
  return rate.size() == 1 ? fmt::format("{:.17g}", rate.front()) : fmt::format("({:.17g})", fmt::join(rate, ", "));
}

/// A line for each list; whether all hold.
bool say_comparison(std::vector<RateComparison> const& all, double limit) {
  bool holds = !all.empty();
  for (RateComparison const& one : all) {
    holds = holds && one.holds;
    std::string const what =
        !one.problem.empty() ? one.problem
        : one.holds && one.linf <= limit
            ? fmt::format("within {:g} of the largest (at most {:.2g} off)", limit, one.linf)
        : one.holds ? fmt::format("off by no more than rounding of its terms ({:.2g} of the largest)", one.linf)
                    : fmt::format("off by l1 {:.2e}, l2 {:.2e}, linf {:.2e} of the largest; worst is particle {}: {}, expected {}",
                                  one.l1, one.l2, one.linf, one.worst, text_of(one.theirs), text_of(one.ours));
    fmt::print("{} {} {}: {}\n", one.holds ? "passed" : "failed", printable(one.scheme), printable(one.quantity), printable(what));
  }
  return holds;
}

void evaluate(EvaluateCommand const& command) {
  for (std::string const& path : command.plugins) load_plugin_for_user(path, path, "");
  std::string const output = command.output.empty() && command.against.empty() ? "-" : command.output;
  if (!output.empty()) require_writable(output, command.state);
  std::set<std::string> only(command.only.begin(), command.only.end());
  for (std::string const& id : only) {
    std::vector<std::string> known{"viscosity/monaghan", "viscosity/monaghan-no-walls", "viscosity/riemann",
                                   "viscosity/riemann-no-walls"};
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      known.emplace_back(scheme->id);
      known.push_back(std::string(scheme->id) + "-no-walls");
    }
    if (std::find(known.begin(), known.end(), id) == known.end())
      throw UserError("evaluate", "--only", fmt::format("'{}'", id), one_listed_by("sphverify list formulations", id, known));
  }
  Json const state = read_json_file(command.state);
  if (command.against.empty()) {
    Json const rates = evaluate_state(Node(state, command.state), only);
    say_remarks(command.state, rates);
    return write_document(output, document_text(rates));
  }
  if (!output.empty()) require_writable(output, command.against);
  if (!std::isfinite(command.limit)) throw UserError("evaluate", "--limit", "a number that is not finite", "a positive one");
  Json const theirs = read_json_file(command.against);
  Node const node(theirs, command.against);
  for (std::string const& scheme : schemes_in(node)) only.insert(scheme);
  Json rates = evaluate_state(Node(state, command.state), only);
  say_remarks(command.state, rates);
  bool const is_single = state.value("precision", "double") == "single";
  double const limit = command.limit > 0.0 ? command.limit : is_single ? single_limit : double_limit;
  auto const compared = compare_rates(node, rates, limit);
  if (compared.empty()) throw UserError(command.against, "rates", "no list that is not null", "one or more");
  if (!output.empty()) {
    rates["against"] = {{"file", command.against}, {"limit", limit}, {"lists", Json::array()}};
    for (RateComparison const& one : compared) rates["against"]["lists"].push_back(to_json(one));
    write_document(output, document_text(rates));
  }
  if (!say_comparison(compared, limit)) throw GateFailed();
}

}  // namespace

void add_evaluate(CLI::App& app) {
  auto command = std::make_shared<EvaluateCommand>();
  CLI::App* sub = app.add_subcommand("evaluate", "Rates of every scheme on particles that you give");
  sub->add_option("STATE.json", command->state, "A state document; - for standard input")->required();
  sub->add_option("-o,--output", command->output, "Where the rates go; standard output by default")->type_name("FILE");
  sub->add_option("--against", command->against, "Your own rates, to be compared instead; exit status 1 if they are off")
      ->type_name("RATES.json");
  sub->add_option("--limit", command->limit, "Of the largest difference, relative to the largest rate [1e-12; single precision 4e-6]")
      ->check(CLI::PositiveNumber)
      ->type_name("LIMIT");
  sub->add_option("--only", command->only, "A scheme whose rates are wanted [all]")->allow_extra_args(false)->type_name("FORMULATION");
  sub->add_option("--plugin", command->plugins, "A shared library whose rates are wanted too (sphverify/plugin.h)")
      ->allow_extra_args(false)
      ->type_name("LIBRARY");
  sub->footer(
      "Rates of your own are read from {\"rates\": {\"conduction/brookshaw\": {\"heating\": [...]}}}.\n"
      "Example: sphverify evaluate state.json --against own-rates.json");
  sub->callback([command] { evaluate(*command); });
}

}  // namespace sphverify
