// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "reports/table/series_row.hpp"

namespace sphverify {

// The answer across cases (docs/compare.md, "The answer").
//
// A scene is what a formulation is given and cannot choose: a case with its parameters, the particles'
// layout, the finest resolution. A setting is what one chooses: density, face weight, closure, h/dx and how
// it grows, and so on. Every formulation is judged at one setting for all scenes: that which fails on the
// fewest of them, then diverges on the fewest, then has the smallest error in the geometric mean.

struct SummaryScene {
  std::string case_id, parameters, layout;
  std::string quantity;  ///< the field that the error is of
  int finest = 0;
  auto operator<=>(SummaryScene const&) const = default;
};

/// What a formulation did on one scene.
enum class Outcome { sound, diverging, failed, missing };

/// Of one formulation against the one that stands first, over the scenes on which both are sound: by error,
/// and only where the difference is larger than both intervals.
struct AgainstFirst {
  int nearer = 0, alike = 0, further = 0;
  int unknown = 0;           ///< of those alike: because an error in time is not known
  Number ratio;              ///< of the errors, geometric mean
  Number smallest, largest;  ///< of these ratios
};

/// One formulation on the scenes of a group, at its setting.
struct SummaryRow {
  Setting setting;   ///< of one of its ladders
  std::string name;  ///< of the formulation, as tables name it
  std::string said;  ///< the same in sentences, where several documents have it with its document
  std::string label;
  bool is_control = false;
  std::vector<std::string> choices;  ///< what of the setting was varied, by the names of `setting_words`
  std::size_t settings_tried = 0;    ///< that ran everywhere, among which this one is the best
  std::vector<SeriesRow> ladders;    ///< per scene of the group; empty ones where it is missing
  std::vector<Outcome> outcomes;     ///< likewise
  int failed = 0, diverging = 0, missing = 0;

  Number error;  ///< geometric mean over the sound and diverging scenes, relative where the field is not 0
  Number worst_error;  ///< the largest of them
  std::size_t worst_scene = 0;
  Number order, order_low, order_high;   ///< the lowest; empty if some scene has none
  std::optional<std::size_t> orderless;  ///< a scene that has none, though it has errors
  Number floor, floor_low, floor_high;   ///< of the scene whose floor is the highest
  std::size_t floor_scene = 0;
  Number wall_flux, wall_impulse;  ///< the worst
  Number energy_pair_drift;        ///< the worst; 0 where all are rounding
  Number growing_modes;            ///< the most; none where some scene's are not known
  bool is_linearised = false;      ///< whether modes were looked at
  Number seconds_to_percent;       ///< the longest; empty unless every scene gets there
  bool is_bound = false;           ///< it is an upper bound
  Number percent_resolution;       ///< N at which the law is there on all scenes, where runs were not
  int reach_percent = 0;           ///< scenes whose ladder gets there
  bool is_timed = false;           ///< whether there are times, and errors relative to a field

  int nearest = 0;  ///< scenes on which it is nearer than all others but controls
  AgainstFirst against_first;
};

/// Formulations that ran the same scenes, the best first, controls behind.
struct SummaryGroup {
  std::vector<SummaryScene> scenes;
  std::string norm;  ///< of the errors; "mixed" where cases differ
  std::vector<SummaryRow> rows;
};

/// Groups of scenes by who ran them, the largest first.
/// @param controls identifiers that never stand first
std::vector<SummaryGroup> summary_of(std::vector<SeriesRow> const& rows,
                                     std::set<std::string> const& controls);

}  // namespace sphverify
