// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/html/page_summary.hpp"

#include <algorithm>

#include "reports/table/summary_text.hpp"

namespace sphverify::page {

namespace {

Json row_json(SummaryGroup const& group, SummaryRow const& row) {
  bool const is_relative = std::all_of(row.ladders.begin(), row.ladders.end(), [](SeriesRow const& ladder) {
    return !ladder.error || ladder.relative_error;
  });
  Json series = Json::array();
  for (std::size_t k = 0; k < row.ladders.size(); ++k) {
    if (row.outcomes[k] != Outcome::missing) series.push_back(row.ladders[k].index);
  }
  return {{"name", row.name},
          {"series", std::move(series)},
          {"setting", setting_text(row)},
          {"is_control", row.is_control},
          {"is_relative", is_relative},
          {"scenes", row.ladders.size()},
          {"failed", row.failed},
          {"missing", row.missing},
          {"diverging", row.diverging},
          {"error", number(row.error)},
          {"worst_error", number(row.worst_error)},
          {"worst_scene", row.worst_error ? scene_name(group, row.worst_scene) : ""},
          {"order", {number(row.order), number(row.order_low), number(row.order_high)}},
          {"floor", {number(row.floor), number(row.floor_low), number(row.floor_high)}},
          {"wall_flux", number(row.wall_flux)},
          {"wall_impulse", number(row.wall_impulse)},
          {"energy_drift", number(row.energy_pair_drift)},
          {"growing_modes", number(row.growing_modes)},
          {"is_timed", row.is_timed},
          {"to_percent", number(row.seconds_to_percent)},
          {"is_bound", row.is_bound},
          {"percent_resolution", enough(row.percent_resolution)}};
}

}  // namespace

Json summary_json(std::vector<SummaryGroup> const& groups) {
  Json list = Json::array();
  for (SummaryGroup const& group : groups) {
    auto const [coarsest, finest] =
        std::minmax_element(group.scenes.begin(), group.scenes.end(),
                            [](SummaryScene const& a, SummaryScene const& b) { return a.finest < b.finest; });
    Json json = {{"cases", cases_of(group)},
                 {"layouts", layouts_of(group)},
                 {"finest", {coarsest->finest, finest->finest}},
                 {"norm", group.norm},
                 {"sentences", sentences(group)},
                 {"rows", Json::array()}};
    for (SummaryRow const& row : group.rows) json["rows"].push_back(row_json(group, row));
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace sphverify::page
