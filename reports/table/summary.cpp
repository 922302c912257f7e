// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "reports/table/best_setting.hpp"

namespace sphverify {

namespace {

std::string room_of(std::string const& id) { return id.substr(0, id.find('/')); }

/// The field of an error. What failed on every level has none of its own; and heat that compression makes is
/// not heat that flows.
std::string quantity_of(SeriesRow const& row, std::vector<SeriesRow> const& rows) {
  std::string field = row.field;
  for (SeriesRow const& other : rows) {
    if (!field.empty()) break;
    if (other.case_id == row.case_id && room_of(other.choice.id) == room_of(row.choice.id))
      field = other.field;
  }
  return field == "heating" ? room_of(row.choice.id) + " " + field : field;
}

/// All that one formulation did.
struct Formulation {
  std::string key, name;
  bool is_control = false;
  std::vector<SeriesRow const*> ladders;
  std::vector<std::size_t> scene_of;  ///< of each ladder
  BestSetting best;
};

std::size_t place_of(std::vector<SummaryScene>& scenes, SummaryScene const& scene) {
  auto const place =
      static_cast<std::size_t>(std::find(scenes.begin(), scenes.end(), scene) - scenes.begin());
  if (place == scenes.size()) scenes.push_back(scene);
  return place;
}

std::vector<Formulation> formulations_of(std::vector<SeriesRow> const& rows,
                                         std::set<std::string> const& controls,
                                         std::vector<SummaryScene>& scenes) {
  SettingNames const names({rows.begin(), rows.end()});
  std::vector<Formulation> all;
  for (SeriesRow const& row : rows) {
    std::string const name = names.formulation(row);
    std::string const key = room_of(row.choice.id) + "/" + name + " " + row.document;
    auto found = std::find_if(all.begin(), all.end(), [&](Formulation const& f) { return f.key == key; });
    if (found == all.end()) {
      all.push_back({key, name, !row.choice.walls || controls.contains(row.choice.id), {}, {}, {}});
      found = std::prev(all.end());
    }
    found->ladders.push_back(&row);
    found->scene_of.push_back(
        place_of(scenes, {row.case_id, row.parameters, layout_name(row.discretisation.layout),
                          quantity_of(row, rows), row.finest}));
  }
  for (Formulation& one : all) one.best = best_setting(one.ladders, one.scene_of, scenes.size());
  return all;
}

/// What a ladder's error may be off: by the seeds, by time stepping, by rounding; as `error_of`.
double uncertainty_of(SeriesRow const& ladder) {
  double const scale = *ladder.error > 0.0 ? *error_of(ladder) / *ladder.error : 1.0;
  double const share = std::min(ladder.time_error_share.value_or(0.0), 1.0);
  return scale *
         (ladder.seed_half_width.value_or(0.0) + share * *ladder.error + ladder.round_off.value_or(0.0));
}

enum class Order { nearer, alike, further };

Order order_of(SeriesRow const& ladder, SeriesRow const& other) {
  if (ladder.time_error_is_unknown || other.time_error_is_unknown) return Order::alike;
  double const difference = *error_of(ladder) - *error_of(other);
  if (std::abs(difference) <= uncertainty_of(ladder) + uncertainty_of(other)) return Order::alike;
  return difference < 0.0 ? Order::nearer : Order::further;
}

bool has_error(SummaryRow const& row, std::size_t scene) {
  return row.outcomes[scene] == Outcome::sound && error_of(row.ladders[scene]).has_value();
}

AgainstFirst against(SummaryRow const& row, SummaryRow const& first) {
  AgainstFirst result;
  double log_ratio = 0.0;
  int known = 0;
  for (std::size_t k = 0; k < row.outcomes.size(); ++k) {
    if (!has_error(row, k) || !has_error(first, k)) continue;
    Order const order = order_of(row.ladders[k], first.ladders[k]);
    result.nearer += order == Order::nearer;
    result.alike += order == Order::alike;
    result.further += order == Order::further;
    result.unknown += row.ladders[k].time_error_is_unknown || first.ladders[k].time_error_is_unknown;
    double const ratio = *error_of(row.ladders[k]) / *error_of(first.ladders[k]);
    result.smallest = std::min(result.smallest.value_or(ratio), ratio);
    result.largest = std::max(result.largest.value_or(ratio), ratio);
    log_ratio += std::log(ratio);
    ++known;
  }
  if (known > 0) result.ratio = std::exp(log_ratio / known);
  return result;
}

void keep_largest(Number& largest, Number const& value) {
  if (value) largest = std::max(largest.value_or(*value), *value);
}

void add_errors(SummaryRow& row) {
  double sum = 0.0;
  int known = 0;
  for (std::size_t k = 0; k < row.ladders.size(); ++k) {
    if (row.outcomes[k] == Outcome::missing) continue;
    Number const error = error_of(row.ladders[k]);
    if (!error) continue;
    sum += std::log(*error);
    ++known;
    if (row.worst_error && *error <= *row.worst_error) continue;
    row.worst_error = error;
    row.worst_scene = k;
  }
  if (known > 0) row.error = std::exp(sum / known);
}

void add_times(SummaryRow& row) {
  bool is_known = true;
  Number furthest;
  for (SeriesRow const& ladder : row.ladders) {
    row.is_timed = row.is_timed || (ladder.seconds && ladder.relative_error);
    if (ladder.to_percent.seconds) {
      ++row.reach_percent;
      if (!row.seconds_to_percent || *ladder.to_percent.seconds > *row.seconds_to_percent) {
        row.seconds_to_percent = ladder.to_percent.seconds;
        row.is_bound = ladder.to_percent.is_bound;
      }
    } else {
      is_known = is_known && ladder.percent_target.resolution.has_value();
      keep_largest(furthest, ladder.percent_target.resolution);
    }
  }
  if (row.reach_percent == static_cast<int>(row.ladders.size())) return;
  row.seconds_to_percent.reset();
  row.is_bound = false;
  if (is_known) row.percent_resolution = furthest;
}

/// That modes grow on one scene is enough; that none does has to be known of every scene that was looked at.
void add_modes(SummaryRow& row) {
  bool is_known = true;
  for (SeriesRow const& ladder : row.ladders) {
    if (!ladder.stability) continue;
    row.is_linearised = true;
    auto const& growing = ladder.stability->growing_modes;
    is_known = is_known && growing;
    if (growing) keep_largest(row.growing_modes, static_cast<double>(*growing));
  }
  if (!is_known && row.growing_modes == 0.0) row.growing_modes.reset();
}

void add_numbers(SummaryRow& row) {
  for (std::size_t k = 0; k < row.ladders.size(); ++k) {
    SeriesRow const& ladder = row.ladders[k];
    if (!ladder.failures.empty()) continue;
    // What has no order somewhere, as on a floor, has none as worst.
    if (ladder.error && !ladder.order && !row.orderless) row.orderless = k;
    if (ladder.order && ladder.lower && ladder.upper && (!row.order || *ladder.order < *row.order)) {
      row.order = ladder.order;
      row.order_low = ladder.lower;
      row.order_high = ladder.upper;
    }
    if (ladder.floor && (!row.floor || *ladder.floor > *row.floor)) {
      row.floor = ladder.floor;
      row.floor_low = ladder.floor_low;
      row.floor_high = ladder.floor_high;
      row.floor_scene = k;
    }
    if (ladder.heat_crosses_walls) keep_largest(row.wall_flux, ladder.wall_flux_error);
    keep_largest(row.wall_impulse, ladder.wall_impulse_defect);
    if (ladder.energy_pair_drift) {
      double const drift = std::abs(*ladder.energy_pair_drift);
      keep_largest(row.energy_pair_drift, drift <= ladder.energy_rounding.value_or(0.0) ? 0.0 : drift);
    }
  }
  if (row.orderless) row.order = row.order_low = row.order_high = std::nullopt;
}

SummaryRow row_of(Formulation const& formulation, std::vector<std::size_t> const& scenes) {
  SummaryRow row;
  row.name = formulation.name;
  row.is_control = formulation.is_control;
  row.choices = formulation.best.choices;
  row.settings_tried = formulation.best.tried;
  row.label = formulation.ladders.front()->formulation;
  row.setting = *formulation.ladders.front();
  bool is_named = false;
  for (std::size_t const scene : scenes) {
    SeriesRow const* const ladder = formulation.best.ladders[scene];
    Outcome const outcome = outcome_of(ladder);
    row.outcomes.push_back(outcome);
    row.ladders.push_back(ladder == nullptr ? SeriesRow{} : *ladder);
    row.failed += outcome == Outcome::failed;
    row.diverging += outcome == Outcome::diverging;
    row.missing += outcome == Outcome::missing;
    if (ladder == nullptr || is_named) continue;
    row.setting = *ladder;
    row.label = ladder->formulation;
    is_named = true;
  }
  add_errors(row);
  add_times(row);
  add_modes(row);
  add_numbers(row);
  return row;
}

Score score_of(SummaryRow const& row) {
  std::vector<SeriesRow const*> ladders;
  for (std::size_t k = 0; k < row.ladders.size(); ++k)
    ladders.push_back(row.outcomes[k] == Outcome::missing ? nullptr : &row.ladders[k]);
  return sphverify::score_of(ladders);
}

void rank(SummaryGroup& group) {
  std::stable_sort(group.rows.begin(), group.rows.end(), [](SummaryRow const& a, SummaryRow const& b) {
    return a.is_control != b.is_control ? b.is_control : score_of(a) < score_of(b);
  });
  for (SummaryRow& row : group.rows) row.against_first = against(row, group.rows.front());
  for (std::size_t k = 0; k < group.scenes.size(); ++k) {
    for (SummaryRow& row : group.rows) {
      if (row.is_control || !has_error(row, k)) continue;
      row.nearest += std::all_of(group.rows.begin(), group.rows.end(), [&](SummaryRow const& other) {
        return &other == &row || other.is_control || !has_error(other, k) ||
               order_of(row.ladders[k], other.ladders[k]) == Order::nearer;
      });
    }
  }
}

/// Scenes by the formulations that ran them, controls aside.
std::vector<std::vector<std::size_t>> scenes_by_who_ran(std::vector<Formulation> const& formulations,
                                                        std::size_t scenes) {
  std::vector<std::set<std::size_t>> ran(scenes);
  for (std::size_t f = 0; f < formulations.size(); ++f) {
    if (formulations[f].is_control) continue;
    for (std::size_t const scene : formulations[f].scene_of) ran[scene].insert(f);
  }
  std::vector<std::pair<std::set<std::size_t>, std::vector<std::size_t>>> groups;
  for (std::size_t k = 0; k < scenes; ++k) {
    auto found = std::find_if(groups.begin(), groups.end(), [&](auto const& g) { return g.first == ran[k]; });
    if (found == groups.end()) found = groups.insert(groups.end(), {ran[k], {}});
    found->second.push_back(k);
  }
  std::stable_sort(groups.begin(), groups.end(), [](auto const& a, auto const& b) {
    auto const weight = [](auto const& g) {
      return std::pair(g.first.size() > 1, g.first.size() * g.second.size());
    };
    return weight(a) > weight(b);
  });
  std::vector<std::vector<std::size_t>> all;
  for (auto& group : groups) all.push_back(std::move(group.second));
  return all;
}

}  // namespace

std::vector<SummaryGroup> summary_of(std::vector<SeriesRow> const& rows,
                                     std::set<std::string> const& controls) {
  std::vector<SummaryScene> scenes;
  std::vector<Formulation> const formulations = formulations_of(rows, controls, scenes);
  std::vector<SummaryGroup> groups;
  for (auto const& members : scenes_by_who_ran(formulations, scenes.size())) {
    SummaryGroup& group = groups.emplace_back();
    for (std::size_t const scene : members) group.scenes.push_back(scenes[scene]);
    for (Formulation const& formulation : formulations) {
      bool const ran = std::any_of(members.begin(), members.end(), [&](std::size_t scene) {
        return std::find(formulation.scene_of.begin(), formulation.scene_of.end(), scene) !=
               formulation.scene_of.end();
      });
      if (ran) group.rows.push_back(row_of(formulation, members));
    }
    for (SummaryRow const& row : group.rows) {
      for (SeriesRow const& ladder : row.ladders) {
        if (ladder.norm.empty()) continue;
        if (group.norm.empty()) group.norm = ladder.norm;
        if (group.norm != ladder.norm) group.norm = "mixed";
      }
    }
    rank(group);
    for (SummaryRow& row : group.rows) {
      auto const namesakes = std::count_if(group.rows.begin(), group.rows.end(),
                                           [&](SummaryRow const& other) { return other.name == row.name; });
      row.said = namesakes > 1 ? row.name + " (" + row.setting.document + ")" : row.name;
    }
  }
  return groups;
}

}  // namespace sphverify
