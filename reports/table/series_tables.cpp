// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/series_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "reports/table/budget_tables.hpp"
#include "reports/table/ladder_counts.hpp"
#include "reports/table/number_text.hpp"
#include "reports/table/pivot.hpp"
#include "reports/table/time_ratio.hpp"

namespace sphverify {

namespace {

Cell error_cell(SeriesRow const& row) {
  if (!row.failures.empty()) return {row.failures, std::nullopt};
  if (!row.error) return {"-", std::nullopt};
  std::string const error = scientific(row.relative_error ? row.relative_error : row.error);
  Number const value = row.relative_error ? row.relative_error : row.error;
  if (row.verdict == "asymptotic" && row.order && row.lower && row.upper) {
    return {error + " " + order_with_interval(*row.order, *row.lower, *row.upper), value};
  }
  if (row.verdict == "pre-asymptotic" && row.order)
    return {fmt::format("{} ~{:.1f}", error, *row.order), value};
  if (row.verdict == "diverging") return {error + " diverges", value};
  if (row.verdict == "not-refined") return {error + " short", value};
  return {error + " " + row.verdict, value};
}

Cell wall_flux_cell(SeriesRow const& row) {
  if (!row.failures.empty()) return {row.failures, std::nullopt};
  return {percent(row.wall_flux_error), row.wall_flux_error};
}

/// Pressure behind the shock, and what the wall has heated too much.
Cell shock_cell(SeriesRow const& row) {
  if (!row.failures.empty()) return {row.failures, std::nullopt};
  if (!row.plateau_pressure) return {"-", std::nullopt};
  std::string text = signed_percent(*row.plateau_pressure);
  if (row.wall_heating) text += " / " + signed_percent(*row.wall_heating);
  return {text, std::abs(std::stod(signed_percent(*row.plateau_pressure)))};  // alike is what reads alike
}

Cell impulse_cell(SeriesRow const& row) {
  if (!row.failures.empty()) return {row.failures, std::nullopt};
  if (!row.wall_impulse_defect) return {"-", std::nullopt};
  return {percent(row.wall_impulse_defect), row.wall_impulse_defect};
}

Cell time_cell(SeriesRow const& row, TimeTable const& times) {
  if (!row.failures.empty()) return {row.failures, std::nullopt};
  TimeTable::Entry const entry = times.entry(row);
  return {entry.text, entry.is_fastest ? Number(1.0) : std::nullopt};  // only the fastest may be marked
}

/// What a table shows together: errors of different fields, or at different resolutions, do not compare.
using TableKey = std::tuple<std::string, std::string, std::string, int>;

TableKey key_of(SeriesRow const& row) { return {row.case_id, row.parameters, row.field, row.finest}; }

/// @param rows of one key
std::vector<TextTable> tables_of(std::vector<SeriesRow> const& rows, std::string const& region) {
  SeriesRow const& first = rows.front();
  auto const has = [&](auto member) {
    return std::any_of(rows.begin(), rows.end(), [&](SeriesRow const& r) { return (r.*member).has_value(); });
  };
  auto const title = [&](std::string const& words) {
    return fmt::format("{}: {}, N = {}", first.case_id, words, first.finest);
  };
  std::vector<TextTable> tables;
  std::string const heading =
      first.parameters.empty() ? first.case_id : fmt::format("{}\n  {}", first.case_id, first.parameters);
  tables.push_back(pivot(fmt::format("{}\n{} error of {}, region {}, N = {}: order or verdict", heading,
                                     first.norm, first.field, region, first.finest),
                         rows, error_cell));
  if (has(&SeriesRow::wall_flux_error))
    tables.push_back(pivot(title("error of the heat flux through the walls"), rows, wall_flux_cell));
  if (has(&SeriesRow::plateau_pressure))
    tables.push_back(
        pivot(title("errors of pressure behind the shock / energy at the wall"), rows, shock_cell));
  if (has(&SeriesRow::wall_impulse_defect))
    tables.push_back(
        pivot(title("impulse that a wall gave, against what it prescribes"), rows, impulse_cell));
  for (TextTable& budget : budget_tables(rows)) tables.push_back(std::move(budget));
  for (auto const& [percent, target] :
       {std::pair{"1%", &SeriesRow::to_percent}, {"0.1%", &SeriesRow::to_permille}}) {
    TimeTable const times(rows, target);
    if (times.is_empty()) continue;
    tables.push_back(pivot(fmt::format("{}: run time to {} error, region {}, fastest of its file = 1",
                                       first.case_id, percent, region),
                           rows, [&times](SeriesRow const& row) { return time_cell(row, times); }));
  }
  return tables;
}

}  // namespace

std::vector<LegendEntry> series_legend() {
  return {
      {"*", "best of its column"},
      {"(walls off)", "without wall terms"},
      {"(walls mirror)", "images of the particles behind walls in their place"},
      {"(walls dummy)", "fixed layers with extrapolated values in their place"},
      {"(N/25)^0.5", "so h/dx grows with the resolution N"},
      {"1.2±0.1", "order with 95% interval"},
      {"1.2 (1.0-1.9)", "the same, its ends uneven"},
      {"~1.2", "order still changing"},
      {"floored, diverges", "no convergence"},
      {"short", "too few levels for an order"},
      {"settled", "asymptotic"},
      {"unsettled", "order still changing"},
      {"fails", "worse than any number"},
      {"", "The rules of the verdicts: sphverify describe order"},
      {"",
       "Errors are relative to the exact field's norm (absolute where that is zero), wall fluxes to the "
       "largest flux; the last column is their median where heat crosses walls."},
      {"",
       "Run times: ratios of medians with 95% interval, 1.09±0.05 or 2.4 (1.9-3.1), where repeats give one"},
      {"*", "the fastest"},
      {"~", "cannot be told from it"},
      {"<=", "the coarsest level got there"},
      {">=", "the fastest's coarsest level did"},
      {"", "Only times of one results file are compared."},
      {"rounding", "a budget closed as far as rounding allows"},
      {"~2e-3 of a step", "by theory alone"},
      {"none", "no step is stable"},
      {"", "What the tables show and how: docs/compare.md"}};
}

std::string series_text(Comparison const& comparison) {
  std::vector<SeriesRow> const& rows = comparison.rows;
  TextStyle const& style = comparison.options.style;
  if (rows.empty()) return "";
  std::vector<TableKey> keys;
  for (SeriesRow const& row : rows) {
    if (std::find(keys.begin(), keys.end(), key_of(row)) == keys.end()) keys.push_back(key_of(row));
  }
  std::string text;
  for (TableKey const& key : keys) {
    std::vector<SeriesRow> chosen;
    for (SeriesRow const& row : rows) {
      if (key_of(row) == key) chosen.push_back(row);
    }
    for (TextTable const& table : tables_of(chosen, comparison.options.region))
      text += render(table, style) + "\n";
  }
  text += render(ladder_counts(rows, comparison.options), style);
  std::string const disturbed = disturbance(rows);
  return disturbed.empty() ? text : text + "\n" + legend({{"", disturbed}}, style);
}

}  // namespace sphverify
