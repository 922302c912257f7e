// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/ladder_counts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/table/number_text.hpp"

namespace sphverify {

TextTable ladder_counts(std::vector<SeriesRow> const& rows, CompareOptions const& options) {
  TextTable table;
  table.title = fmt::format("All ladders, whatever their setting: how they ended ({} error, region {})",
                            options.norm.empty() ? "l1 at jumps, else l2" : options.norm, options.region);
  table.header = {"formulation", "ladders", "settled", "unsettled", "floored",
                  "diverge",     "fail",    "median",  "worst",     "wall flux"};
  SettingNames const names({rows.begin(), rows.end()});
  bool const several = std::any_of(
      rows.begin(), rows.end(), [&](SeriesRow const& row) { return row.document != rows.front().document; });
  if (several) {
    table.header.insert(table.header.begin() + 1, "results");
    table.label_columns = 2;
  }
  std::vector<std::pair<std::string, std::string>> keys;  // formulation, document
  for (SeriesRow const& row : rows) {
    std::pair const key(names.formulation(row), row.document);
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  }
  auto const median = [](std::vector<double> values) -> Number {
    if (values.empty()) return std::nullopt;
    std::sort(values.begin(), values.end());
    std::size_t const n = values.size();
    return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
  };
  for (auto const& key : keys) {
    int asymptotic = 0, unsettled = 0, floored = 0, diverges = 0, fails = 0, ladders = 0;
    std::vector<double> errors, fluxes;
    for (SeriesRow const& row : rows) {
      if (std::pair(names.formulation(row), row.document) != key) continue;
      ++ladders;
      if (!row.failures.empty()) {
        ++fails;
        errors.push_back(INFINITY);  // no number is worse
        continue;
      }
      asymptotic += row.verdict == "asymptotic";
      unsettled += row.verdict == "pre-asymptotic";
      floored += row.verdict == "floored";
      diverges += row.verdict == "diverging";
      if (row.relative_error) errors.push_back(*row.relative_error);
      if (row.wall_flux_error && row.heat_crosses_walls) fluxes.push_back(*row.wall_flux_error);
    }
    auto& cells = table.rows.emplace_back(std::vector<std::string>{
        key.first, fmt::format("{}", ladders), fmt::format("{}", asymptotic), fmt::format("{}", unsettled),
        fmt::format("{}", floored), fmt::format("{}", diverges), fmt::format("{}", fails),
        scientific(median(errors)),
        scientific(errors.empty() ? Number() : Number(*std::max_element(errors.begin(), errors.end()))),
        percent(median(fluxes))});
    if (several) cells.insert(cells.begin() + 1, key.second);
  }
  return table;
}

}  // namespace sphverify
