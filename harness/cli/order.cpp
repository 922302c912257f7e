// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "harness/cli/commands.hpp"
#include "harness/cli/option_facts.hpp"
#include "harness/measure/ladder_table.hpp"
#include "harness/terminal.hpp"
#include "reports/json/results_json.hpp"
#include "reports/table/number_text.hpp"
#include "reports/table/text_table.hpp"

namespace sphverify {

namespace {

struct OrderCommand {
  std::string table;
  std::string format = "table";
  std::vector<double> targets{0.01, 0.001};
  double allowed = 0.0;  ///< 0: not known
};

struct JudgedColumn {
  std::string name;
  ObservedOrder observed;
};

JudgedColumn judge(LadderColumn const& column, OrderCommand const& command) {
  LadderContext context;
  if (command.allowed > 0.0) context.allowed = command.allowed;
  JudgedColumn judged{column.name, observed_order(column.levels, context)};
  LadderExtent const extent = extent_of(column.levels, 1.0);
  for (double const target : command.targets)
    judged.observed.targets.push_back(resolution_for(judged.observed, target, extent));
  return judged;
}

std::string order_text(ObservedOrder const& observed) {
  if (!observed.order) return "-";
  if (!observed.lower) return fmt::format("{:.2f}", *observed.order);
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", *observed.order, *observed.lower, *observed.upper);
}

std::string floor_text(ObservedOrder const& observed) {
  if (!observed.floor) return "-";
  return fmt::format("{} [{}, {}]", scientific(observed.floor->value), scientific(observed.floor->lower),
                     scientific(observed.floor->upper));
}

std::string target_text(TargetResolution const& target) {
  if (target.resolution)
    return fmt::format("{}{:.3g}", target.remark == coarsest_has_it ? "<=" : "", *target.resolution);
  return target.remark.starts_with("never") ? "never" : "-";
}

std::string readable(std::vector<JudgedColumn> const& columns, OrderCommand const& command) {
  TextTable table;
  table.header = {"column", "verdict", "order", "floor"};
  for (double const target : command.targets) table.header.push_back(fmt::format("N for {:g}", target));
  std::size_t const width = known_columns().value_or(usual_columns);
  std::string reasons;
  for (JudgedColumn const& column : columns) {
    auto& cells = table.rows.emplace_back(std::vector<std::string>{
        column.name, column.observed.verdict, order_text(column.observed), floor_text(column.observed)});
    for (TargetResolution const& target : column.observed.targets) cells.push_back(target_text(target));
    reasons += hanging_lines(column.name + ": ", column.observed.reason, 2, width);
  }
  return render(table, {TableFormat::table, false, width}) + "\n" + reasons;
}

Json json(std::vector<JudgedColumn> const& columns) {
  Json document = {{"schema", "sphverify-orders/1"}, {"columns", Json::object()}};
  for (JudgedColumn const& column : columns) document["columns"][column.name] = to_json(column.observed);
  return document;
}

/// The library's check of a range lets pass what is no number.
void require_numbers(OrderCommand const& command) {
  for (double const target : command.targets) {
    if (std::isnan(target)) throw UserError("order", "--target", "nan", "errors above 0");
  }
  if (std::isnan(command.allowed)) throw UserError("order", "--allowed", "nan", "an order above 0");
}

void judge_table(OrderCommand const& command) {
  require_numbers(command);
  std::vector<JudgedColumn> judged;
  for (LadderColumn const& column : read_ladder_table(command.table))
    judged.push_back(judge(column, command));
  write_document("-", command.format == "json" ? document_text(json(judged)) : readable(judged, command));
}

}  // namespace

void add_order(CLI::App& app) {
  auto command = std::make_shared<OrderCommand>();
  CLI::App* sub = app.add_subcommand("order", "Order of convergence, floor and verdict of anybody's errors");
  sub->add_option(
         "TABLE.csv", command->table,
         "Comma-separated: a line of names, N (particles along an axis) or spacing among them, seed if "
         "there are replicates, every other an error (empty or nan: the run failed); levels differ by 1e-6 "
         "or more of themselves; - is standard input")
      ->required();
  take_one_of(sub->add_option("--format", command->format, "How the answer is written [table]"), {"table", "json"});
  sub->add_option("--target", command->targets,
                  "Errors whose N (1/spacing) is wanted, in the columns' unit; default: 0.01 0.001")
      ->check(CLI::Range(1e-300, 1e300))
      ->type_name("ERROR");
  sub->add_option("--allowed", command->allowed, "Highest order that the solution allows; default: any")
      ->check(CLI::Range(1e-3, 100.0))
      ->type_name("ORDER");
  sub->footer(
      "Of a results document: N, seed and one of l1, l2, linf of one ladder of `compare --section levels`; "
      "its "
      "orders and floors are those of absolute errors.\n"
      "The rules: sphverify describe order\n"
      "Example: printf 'N,l2\\n10,0.195\\n20,0.11\\n40,0.0566\\n80,0.0285\\n' | sphverify order -");
  sub->callback([command] { judge_table(*command); });
}

}  // namespace sphverify
