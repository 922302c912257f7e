// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/best_setting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace sphverify {

namespace {

/// What one chooses, by name. The layout is none: one has to live with the particles that one has.
std::vector<std::pair<std::string, std::string>> choices_of(SeriesRow const& ladder) {
  auto words = setting_words(ladder);
  std::erase_if(words, [](auto const& word) { return word.first == "layout"; });
  return words;
}

/// By which values on one case are collected.
std::string case_of(SeriesRow const& ladder) { return ladder.case_id + " " + ladder.parameters; }

/// One value for each choice; an empty word where there is no choice.
using Assignment = std::vector<std::string>;

bool agree(Assignment const& setting, Assignment const& ladder) {
  for (std::size_t c = 0; c < setting.size(); ++c) {
    if (!ladder[c].empty() && setting[c] != ladder[c]) return false;
  }
  return true;
}

/// All combinations of the values that each choice took.
std::vector<Assignment> combinations(std::vector<std::vector<std::string>> const& values) {
  std::vector<Assignment> all{Assignment(values.size())};
  for (std::size_t c = 0; c < values.size(); ++c) {
    if (values[c].empty()) continue;
    std::vector<Assignment> longer;
    for (Assignment const& one : all) {
      for (std::string const& value : values[c]) {
        longer.push_back(one);
        longer.back()[c] = value;
      }
    }
    all = std::move(longer);
  }
  return all;
}

/// Whether a setting ran on all scenes that its formulation did.
bool covers(std::vector<SeriesRow const*> const& chosen, std::vector<std::size_t> const& scene_of) {
  return std::all_of(scene_of.begin(), scene_of.end(),
                     [&](std::size_t scene) { return chosen[scene] != nullptr; });
}

/// Of two ladders of one scene and setting, as of documents of the same runs, the worse.
SeriesRow const* worse(SeriesRow const* a, SeriesRow const* b) {
  if (a == nullptr || b == nullptr) return a == nullptr ? b : a;
  return score_of({a}) < score_of({b}) ? b : a;
}

}  // namespace

Outcome outcome_of(SeriesRow const* ladder) {
  if (ladder == nullptr) return Outcome::missing;
  if (!ladder->failures.empty()) return Outcome::failed;
  return ladder->verdict == "diverging" ? Outcome::diverging : Outcome::sound;
}

Number error_of(SeriesRow const& ladder) {
  if (!ladder.failures.empty() || !ladder.error || !std::isfinite(*ladder.error)) return std::nullopt;
  double const scale =
      ladder.relative_error && *ladder.relative_error > 0.0 ? *ladder.error / *ladder.relative_error : 1.0;
  double const rounding = std::max(ladder.round_off.value_or(0.0), std::numeric_limits<double>::min());
  return std::max(*ladder.error, rounding) / scale;
}

Score score_of(std::vector<SeriesRow const*> const& ladders) {
  Score score;
  int known = 0;
  for (SeriesRow const* ladder : ladders) {
    Outcome const outcome = outcome_of(ladder);
    score.failed += outcome == Outcome::failed || outcome == Outcome::missing;
    score.diverging += outcome == Outcome::diverging;
    Number const error = ladder == nullptr ? std::nullopt : error_of(*ladder);
    if (!error) continue;
    score.log_error += std::log(*error);
    ++known;
  }
  score.log_error = known > 0 ? score.log_error / known : std::numeric_limits<double>::infinity();
  return score;
}

BestSetting best_setting(std::vector<SeriesRow const*> const& ladders,
                         std::vector<std::size_t> const& scene_of, std::size_t scenes) {
  BestSetting best;
  best.ladders.assign(scenes, nullptr);
  if (ladders.empty()) return best;
  std::vector<std::string> names;
  for (auto const& [name, value] : choices_of(*ladders.front())) names.push_back(name);

  std::map<std::string, std::vector<std::set<std::string>>> on_case;
  for (SeriesRow const* ladder : ladders) {
    auto& sets = on_case[case_of(*ladder)];
    sets.resize(names.size());
    auto const words = choices_of(*ladder);
    for (std::size_t c = 0; c < names.size(); ++c) sets[c].insert(words[c].second);
  }
  std::vector<Assignment> of_ladder;
  std::vector<std::vector<std::string>> values(names.size());
  for (SeriesRow const* ladder : ladders) {
    auto const& sets = on_case.at(case_of(*ladder));
    auto words = choices_of(*ladder);
    auto& assignment = of_ladder.emplace_back(names.size());
    for (std::size_t c = 0; c < names.size(); ++c) {
      if (sets[c].size() < 2) continue;
      assignment[c] = words[c].second;
      if (std::find(values[c].begin(), values[c].end(), assignment[c]) == values[c].end())
        values[c].push_back(assignment[c]);
    }
  }
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (!values[c].empty()) best.choices.push_back(names[c]);
  }

  bool is_first = true;
  best.tried = 0;
  for (Assignment const& setting : combinations(values)) {
    std::vector<SeriesRow const*> chosen(scenes, nullptr);
    for (std::size_t k = 0; k < ladders.size(); ++k) {
      if (agree(setting, of_ladder[k])) chosen[scene_of[k]] = worse(chosen[scene_of[k]], ladders[k]);
    }
    best.tried += covers(chosen, scene_of);
    if (!is_first && !(score_of(chosen) < score_of(best.ladders))) continue;
    best.ladders = std::move(chosen);
    is_first = false;
  }
  return best;
}

}  // namespace sphverify
