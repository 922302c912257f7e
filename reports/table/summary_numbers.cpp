// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/summary_numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/table/summary_text.hpp"

namespace sphverify {

namespace {

std::vector<std::pair<std::string, std::string>> words_of(SummaryGroup const& group, SummaryRow const& row) {
  std::vector<std::pair<std::string, std::string>> words{
      {"results", row.setting.document}, {"formulation", row.label}, {"name", row.name}};
  for (auto& [name, value] : setting_words(row.setting)) {
    if (name != "layout") words.emplace_back(name, std::move(value));
  }
  words.emplace_back("worst_scene", row.worst_error ? scene_name(group, row.worst_scene) : "");
  return words;
}

std::vector<std::pair<std::string, int>> counts_of(SummaryRow const& row) {
  return {{"scenes", static_cast<int>(row.ladders.size())},
          {"settings_tried", static_cast<int>(row.settings_tried)},
          {"failed", row.failed},
          {"diverging", row.diverging},
          {"missing", row.missing},
          {"nearest", row.nearest},
          {"nearer_than_first", row.against_first.nearer},
          {"alike_first", row.against_first.alike},
          {"further_than_first", row.against_first.further},
          {"reach_1_percent", row.reach_percent}};
}

std::vector<std::pair<std::string, Number>> numbers_of(SummaryRow const& row) {
  return {{"error", row.error},
          {"worst_error", row.worst_error},
          {"error_ratio", row.against_first.ratio},
          {"smallest_error_ratio", row.against_first.smallest},
          {"largest_error_ratio", row.against_first.largest},
          {"order", row.order},
          {"order_low", row.order_low},
          {"order_high", row.order_high},
          {"floor", row.floor},
          {"floor_low", row.floor_low},
          {"floor_high", row.floor_high},
          {"wall_flux_error", row.wall_flux},
          {"wall_impulse_defect", row.wall_impulse},
          {"energy_pair_drift", row.energy_pair_drift},
          {"growing_modes", row.growing_modes},
          {"seconds_to_1_percent", row.seconds_to_percent},
          {"resolution_of_1_percent", row.percent_resolution}};
}

Json entry_of(SummaryGroup const& group, SummaryRow const& row) {
  Json entry;
  for (auto const& [name, value] : words_of(group, row)) entry[name] = value;
  entry["control"] = row.is_control;
  for (auto const& [name, value] : counts_of(row)) entry[name] = value;
  for (auto const& [name, value] : numbers_of(row)) entry[name] = value ? Json(*value) : Json(nullptr);
  entry["seconds_are_bound"] = row.is_bound;
  return entry;
}

}  // namespace

std::string summary_csv(std::vector<SummaryGroup> const& groups) {
  TextTable table;
  table.header = {"group", "cases", "layouts"};
  SummaryGroup const none{{SummaryScene{}}, "", {}};
  SummaryRow const empty{};
  for (auto const& [name, value] : words_of(none, empty)) table.header.push_back(name);
  table.header.emplace_back("control");
  for (auto const& [name, value] : counts_of(empty)) table.header.push_back(name);
  for (auto const& [name, value] : numbers_of(empty)) table.header.push_back(name);
  table.header.emplace_back("seconds_are_bound");
  for (std::size_t k = 0; k < groups.size(); ++k) {
    for (SummaryRow const& row : groups[k].rows) {
      auto& cells = table.rows.emplace_back(
          std::vector{fmt::format("{}", k + 1), fmt::format("{}", fmt::join(cases_of(groups[k]), "; ")),
                      fmt::format("{}", fmt::join(layouts_of(groups[k]), "; "))});
      for (auto const& [name, value] : words_of(groups[k], row)) cells.push_back(value);
      cells.emplace_back(row.is_control ? "true" : "false");
      for (auto const& [name, value] : counts_of(row)) cells.push_back(fmt::format("{}", value));
      for (auto const& [name, value] : numbers_of(row))
        cells.push_back(value ? fmt::format("{}", *value) : "");
      cells.emplace_back(row.is_bound ? "true" : "false");
    }
  }
  return render(table, {TableFormat::csv});
}

Json summary_json(std::vector<SummaryGroup> const& groups) {
  Json all = Json::array();
  for (SummaryGroup const& group : groups) {
    Json entry = {{"norm", group.norm},
                  {"scenes", Json::array()},
                  {"sentences", sentences(group)},
                  {"formulations", Json::array()}};
    for (SummaryScene const& scene : group.scenes) {
      entry["scenes"].push_back({{"case", scene.case_id},
                                 {"parameters", scene.parameters},
                                 {"layout", scene.layout},
                                 {"field", scene.quantity},
                                 {"finest", scene.finest}});
    }
    for (SummaryRow const& row : group.rows) entry["formulations"].push_back(entry_of(group, row));
    all.push_back(std::move(entry));
  }
  return all;
}

}  // namespace sphverify
