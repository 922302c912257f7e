// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/summary_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "reports/table/number_text.hpp"
#include "reports/table/summary_text.hpp"

namespace sphverify {

namespace {

std::string order_text(SummaryRow const& row) {
  return row.order ? order_with_interval(*row.order, *row.order_low, *row.order_high) : "-";
}

/// A floor that may be none is known from above alone.
std::string floor_text(SummaryRow const& row) {
  if (!row.floor) return "-";
  if (row.floor_low && *row.floor_low > 0.0) return scientific(row.floor);
  return row.floor_high ? "<" + scientific(row.floor_high) : "-";
}

std::string seconds_text(double seconds) {
  if (seconds < 0.0995) return fmt::format("{:.2g} ms", 1e3 * seconds);
  if (seconds < 99.5) return fmt::format("{:.2g} s", seconds);
  return fmt::format("{:.0f} s", seconds);
}

std::string percent_text(SummaryRow const& row) {
  if (row.seconds_to_percent) return (row.is_bound ? "<=" : "") + seconds_text(*row.seconds_to_percent);
  if (row.percent_resolution) return fmt::format("N {:.0f}", std::ceil(*row.percent_resolution - 1e-9));
  return row.is_timed ? "not reached" : "-";
}

std::string count_text(int n, SummaryRow const& row) {
  return n == 0 ? "0" : fmt::format("{}/{}", n, row.ladders.size());
}

struct SummaryColumn {
  char const* name;
  std::function<bool(SummaryRow const&)> has;
  std::function<std::string(SummaryRow const&)> text;
  bool of_controls = true;  ///< shown of controls too
};

std::vector<SummaryColumn> const& columns() {
  static std::vector<SummaryColumn> const all{
      {"error", [](SummaryRow const& r) { return r.error.has_value(); },
       [](SummaryRow const& r) { return scientific(r.error); }},
      {"order", [](SummaryRow const&) { return true; }, order_text},
      {"floor", [](SummaryRow const& r) { return r.floor.has_value(); }, floor_text, false},
      {"wall flux", [](SummaryRow const& r) { return r.wall_flux.has_value(); },
       [](SummaryRow const& r) { return percent(r.wall_flux); }},
      {"wall impulse", [](SummaryRow const& r) { return r.wall_impulse.has_value(); },
       [](SummaryRow const& r) { return percent(r.wall_impulse); }},
      {"energy made", [](SummaryRow const& r) { return r.energy_pair_drift.has_value(); },
       [](SummaryRow const& r) { return percent(r.energy_pair_drift); }, false},
      {"growing modes", [](SummaryRow const& r) { return r.is_linearised; },
       [](SummaryRow const& r) {
         if (r.growing_modes) return fmt::format("{:.0f}", *r.growing_modes);
         return std::string(r.is_linearised ? "not known" : "-");
       },
       false},
      {"1% after", [](SummaryRow const& r) { return r.is_timed || r.percent_resolution; }, percent_text,
       false},
      {"fail", [](SummaryRow const&) { return true; },
       [](SummaryRow const& r) { return count_text(r.failed + r.missing, r); }},
      {"diverge", [](SummaryRow const& r) { return r.diverging > 0; },
       [](SummaryRow const& r) { return count_text(r.diverging, r); }}};
  return all;
}

}  // namespace

std::string shared_setting(SummaryGroup const& group) {
  std::set<std::string> settings;
  for (SummaryRow const& row : group.rows) {
    if (!row.is_control) settings.insert(setting_text(row));
  }
  return settings.size() == 1 ? *settings.begin() : "";
}

TextTable summary_table(SummaryGroup const& group, bool controls) {
  std::vector<SummaryRow const*> rows;
  for (SummaryRow const& row : group.rows) {
    if (row.is_control == controls) rows.push_back(&row);
  }
  bool const several = std::any_of(group.rows.begin(), group.rows.end(), [&](SummaryRow const& row) {
    return row.setting.document != group.rows.front().setting.document;
  });
  TextTable table;
  table.header = {controls ? "control" : "formulation"};
  if (several) table.header.emplace_back("results");
  table.label_columns = table.header.size();
  table.note_name = "setting";
  std::string const shared = shared_setting(group);
  if (!controls && !shared.empty()) table.title = "All at " + shared;
  std::vector<SummaryColumn const*> shown;
  for (SummaryColumn const& column : columns()) {
    if (controls && !column.of_controls) continue;
    if (std::none_of(rows.begin(), rows.end(), [&](SummaryRow const* row) { return column.has(*row); }))
      continue;
    shown.push_back(&column);
    table.header.emplace_back(column.name);
  }
  for (SummaryRow const* row : rows) {
    auto& cells = table.rows.emplace_back(std::vector{row->name});
    if (several) cells.push_back(row->setting.document);
    for (SummaryColumn const* column : shown) cells.push_back(column->text(*row));
    table.notes.push_back(setting_text(*row) == shared ? "" : setting_text(*row));
  }
  if (std::all_of(table.notes.begin(), table.notes.end(), [](auto const& note) { return note.empty(); }))
    table.notes.clear();
  return table;
}

}  // namespace sphverify
