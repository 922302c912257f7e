// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/summary_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "reports/table/number_text.hpp"
#include "reports/table/summary_table.hpp"

namespace sphverify {

namespace {

std::string join(std::vector<std::string> const& words, char const* between = ", ") {
  return fmt::format("{}", fmt::join(words, between));
}

void add_new(std::vector<std::string>& list, std::string const& word) {
  if (std::find(list.begin(), list.end(), word) == list.end()) list.push_back(word);
}

/// "2 cases"
std::string plural(std::size_t n, std::string const& thing) {
  return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
}

/// The parameters in a text; lists among their values hold blanks.
std::vector<std::string> parameters_of(std::string const& text) {
  std::vector<std::string> all;
  std::size_t start = 0;
  for (std::size_t at = text.find(' '); at != std::string::npos; at = text.find(' ', at + 1)) {
    std::size_t const name = at + 1;
    std::size_t end = name;
    while (end < text.size() && (std::islower(static_cast<unsigned char>(text[end])) || text[end] == '_'))
      ++end;
    if (end == name || end == text.size() || text[end] != '=') continue;
    all.push_back(text.substr(start, at - start));
    start = name;
  }
  if (start < text.size()) all.push_back(text.substr(start));
  return all;
}

/// "manufactured drive=pressure": without its room, and with the parameters that differ.
std::string case_name(SummaryGroup const& group, SummaryScene const& scene) {
  std::string name = scene.case_id.substr(scene.case_id.find('/') + 1);
  for (std::string const& parameter : parameters_of(scene.parameters)) {
    bool const differs =
        std::any_of(group.scenes.begin(), group.scenes.end(), [&](SummaryScene const& other) {
          auto const its = parameters_of(other.parameters);
          return other.case_id == scene.case_id && std::find(its.begin(), its.end(), parameter) == its.end();
        });
    if (differs) name += " " + parameter;
  }
  return name;
}

/// Norm and level of the errors: "l2 error, N = 200".
std::string measured_text(SummaryGroup const& group, std::string const& region) {
  int coarsest = group.scenes.front().finest;
  int finest = coarsest;
  for (SummaryScene const& scene : group.scenes) {
    coarsest = std::min(coarsest, scene.finest);
    finest = std::max(finest, scene.finest);
  }
  std::string const norm = group.norm.empty()      ? "no error"
                           : group.norm == "mixed" ? "l1 error at jumps, else l2"
                                                   : group.norm + " error";
  std::string const level =
      coarsest == finest ? fmt::format("N = {}", finest) : fmt::format("N = {} to {}", coarsest, finest);
  return norm + ", " + level + (region == "all" ? "" : ", region " + region);
}

/// "piston-velocity, manufactured (2)": a name once, whatever its parameters; several layouts behind.
std::string scenes_text(SummaryGroup const& group) {
  std::vector<std::string> names;
  for (std::string const& one : cases_of(group)) names.push_back(one.substr(0, one.find(' ')));
  std::vector<std::string> counted;
  for (std::string const& name : names) {
    auto const n = std::count(names.begin(), names.end(), name);
    add_new(counted, n == 1 ? name : fmt::format("{} ({})", name, n));
  }
  auto const layouts = layouts_of(group);
  return layouts.size() == 1 ? join(counted) : join(counted) + "; " + join(layouts);
}

/// "lattice", "2 layouts"
std::string where_text(SummaryGroup const& group) {
  auto const layouts = layouts_of(group);
  return layouts.size() == 1 ? layouts.front() : plural(layouts.size(), "layout");
}

std::string ratio_text(double ratio) {
  if (ratio >= 10000.0) return scientific(ratio);
  return ratio < 0.0995  ? fmt::format("{:.1g}", ratio)
         : ratio < 1.995 ? fmt::format("{:.2f}", ratio)
         : ratio < 9.95  ? fmt::format("{:.1f}", ratio)
                         : fmt::format("{:.0f}", ratio);
}

std::string failure_of(SummaryRow const& row) {
  std::vector<std::string> ways;
  for (SeriesRow const& ladder : row.ladders) {
    if (!ladder.failures.empty()) add_new(ways, ladder.failures.substr(0, ladder.failures.find(' ')));
  }
  return join(ways);
}

/// What went wrong, of so many scenes.
std::vector<std::string> troubles(SummaryRow const& row) {
  std::size_t const scenes = row.ladders.size();
  std::string const of = scenes > 1 ? fmt::format(" of {}", scenes) : "";
  std::vector<std::string> parts;
  auto const add = [&](int n, std::string const& what, std::string const& how) {
    if (n > 0) parts.push_back(scenes > 1 ? fmt::format("{} on {}{}{}", what, n, of, how) : what + how);
  };
  add(row.failed, "fails", " (" + failure_of(row) + ")");
  add(row.missing, "did not run", "");
  add(row.diverging, "diverges", "");
  return parts;
}

std::string error_text(SummaryRow const& row) {
  if (!row.error) return "no error was measured";
  if (row.ladders.size() == 1) return "error " + scientific(row.error);
  return fmt::format("error {} (mean), {} (worst)", scientific(row.error), scientific(row.worst_error));
}

/// On some scene of those on which both are sound.
bool is_told_from_first(SummaryRow const& row) {
  AgainstFirst const& a = row.against_first;
  return a.nearer + a.further > 0 || a.alike == 0;
}

std::string first_sentence(SummaryRow const& row, std::vector<SummaryRow const*> const& others) {
  std::vector<std::string> parts = troubles(row);
  std::size_t const scenes = row.ladders.size();
  bool const is_smallest = std::all_of(others.begin(), others.end(), [](SummaryRow const* other) {
    return !is_told_from_first(*other) || other->against_first.ratio.value_or(1.0) >= 1.0;
  });
  std::vector<std::string> rivals;  // that end as well and whose errors are its own, as far as anybody knows
  for (SummaryRow const* other : others) {
    bool const ends_as_well =
        other->failed == row.failed && other->missing == row.missing && other->diverging == row.diverging;
    if (ends_as_well && !is_told_from_first(*other)) rivals.push_back(other->said);
  }
  if (others.empty() || !row.error) {
    parts.push_back(error_text(row));
  } else if (is_smallest && !rivals.empty()) {
    parts.insert(parts.begin(), error_text(row));
    // Told from the first is not told from each other.
    return rivals.size() == 1
               ? fmt::format("{} and {} cannot be told apart: {}", row.said, rivals.front(), join(parts))
               : fmt::format("{} cannot be told from {}: {}", row.said, join(rivals, " or "), join(parts));
  } else if (is_smallest) {
    std::string const where = scenes == 1        ? ""
                              : row.nearest == 0 ? " in the mean"
                                                 : fmt::format(" on {} of {} scenes", row.nearest, scenes);
    parts.insert(parts.begin(), fmt::format("smallest error{}: {}", where, error_text(row).substr(6)));
  } else {
    parts.insert(parts.begin(), "fails and diverges least: " + error_text(row));
  }
  return row.said + ": " + join(parts);
}

std::string against_text(AgainstFirst const& a, std::string const& first) {
  int const known = a.nearer + a.alike + a.further;
  if (known == 0) return "";
  if (a.alike == known) {
    return "cannot be told from " + first +
           (a.unknown > 0 ? " (errors in time are not known)" : " (intervals overlap)");
  }
  std::string const range = known > 1 && *a.largest > 1.05 * *a.smallest
                                ? fmt::format(" ({} to {})", ratio_text(*a.smallest), ratio_text(*a.largest))
                                : "";
  std::string text = fmt::format("error x{}{}", ratio_text(*a.ratio), range);
  if (a.nearer > 0) text += fmt::format(", nearer on {}", a.nearer);
  if (a.alike > 0) text += fmt::format(", alike on {}", a.alike);
  return text;
}

/// Particles that were drawn once: how much another draw would change is not known.
bool is_drawn_once(SummaryGroup const& group) {
  return std::any_of(group.rows.begin(), group.rows.end(), [](SummaryRow const& row) {
    return std::any_of(row.ladders.begin(), row.ladders.end(), [](SeriesRow const& ladder) {
      return is_drawn(ladder.discretisation.layout) && ladder.error && !ladder.seed_half_width;
    });
  });
}

/// A sentence a line, or in Markdown an entry of a list.
std::string line_of(std::string const& words, TextStyle const& style) {
  if (style.format == TableFormat::markdown) return "- " + words + "\n";
  return hanging_lines("", words, 2, style.columns);
}

std::string sentences_text(SummaryGroup const& group, TextStyle const& style) {
  std::string text;
  for (std::string const& sentence : sentences(group)) text += line_of(sentence, style);
  if (is_drawn_once(group))
    text += line_of("Of each disordered layout one draw was run: how much draws differ is not known.", style);
  return text;
}

/// Of a reason: what follows a semicolon explains it further, in the series.
std::string first_clause(std::string const& reason) { return reason.substr(0, reason.find(';')); }

/// Why the order of the first is missing from a table, and which scenes its floors are of.
std::string below_table(SummaryGroup const& group, bool controls, TextStyle const& style) {
  bool const several = group.scenes.size() > 1;
  std::vector<std::string> floors;
  std::string text;
  for (SummaryRow const& row : group.rows) {
    if (row.is_control != controls) continue;
    if (&row == &group.rows.front() && row.orderless && !controls) {
      std::string const where = several ? scene_name(group, *row.orderless) + ": " : "";
      text += line_of(fmt::format("No order of {}: {}{}.", row.said, where,
                                  first_clause(row.ladders[*row.orderless].reason)),
                      style);
    }
    if (several && row.floor && !controls)
      floors.push_back(row.said + " on " + scene_name(group, row.floor_scene));
  }
  return floors.empty() ? text : text + line_of("Floors: " + join(floors, "; ") + ".", style);
}

std::string in_full(SummaryGroup const& group, CompareOptions const& options) {
  TextStyle const& style = options.style;
  std::string const title =
      fmt::format("Which formulation? {} on {}; {}", plural(cases_of(group).size(), "case"),
                  where_text(group), measured_text(group, options.region));
  std::string text = style.format == TableFormat::markdown
                         ? fmt::format("### {}\n\n{}\n\n", title, scenes_text(group))
                         : hanging_lines("", title, 2, style.columns) +
                               hanging_lines("  ", scenes_text(group), 2, style.columns);
  text += sentences_text(group, style);
  for (bool const controls : {false, true}) {
    TextTable const table = summary_table(group, controls);
    if (table.rows.empty()) continue;
    bool const is_markdown = style.format == TableFormat::markdown;
    std::string const below = below_table(group, controls, style);
    // The whole answer has to fit on a screen of 24 lines.
    bool const is_close = !is_markdown && (controls || !below.empty());
    text +=
        (is_close ? "" : "\n") + render(table, style) + (is_markdown && !below.empty() ? "\n" : "") + below;
  }
  return text;
}

/// A group behind the first.
std::string in_words(SummaryGroup const& group, CompareOptions const& options) {
  TextStyle const& style = options.style;
  std::string const shared = shared_setting(group);
  std::string const title =
      fmt::format("Also {} on {}; {}{}", scenes_text(group), where_text(group),
                  measured_text(group, options.region), shared.empty() ? "" : "; all at " + shared);
  std::string const head = style.format == TableFormat::markdown ? "\n" + title + "\n\n"
                                                                 : hanging_lines("", title, 2, style.columns);
  return head + sentences_text(group, style);
}

}  // namespace

std::string setting_text(SummaryRow const& row) {
  auto const words = setting_words(row.setting);
  auto const is_varied = [&](std::string const& name) {
    return std::find(row.choices.begin(), row.choices.end(), name) != row.choices.end();
  };
  std::vector<std::string> parts;
  for (auto const& [name, value] : words) {
    if (name.starts_with("smoothing_") || (name != "density" && !is_varied(name))) continue;
    std::string spoken = name;
    std::replace(spoken.begin(), spoken.end(), '_', ' ');
    parts.push_back(spoken + " " + value);
  }
  parts.push_back(smoothing_text(row.setting));
  return join(parts);
}

std::vector<std::string> layouts_of(SummaryGroup const& group) {
  std::vector<std::string> layouts;
  for (SummaryScene const& scene : group.scenes) add_new(layouts, scene.layout);
  return layouts;
}

std::vector<std::string> cases_of(SummaryGroup const& group) {
  std::vector<std::string> cases;
  for (SummaryScene const& scene : group.scenes) add_new(cases, case_name(group, scene));
  return cases;
}

std::string scene_name(SummaryGroup const& group, std::size_t scene) {
  SummaryScene const& one = group.scenes[scene];
  std::string name = case_name(group, one);
  if (layouts_of(group).size() > 1) name += ", " + one.layout;
  bool const is_known = std::any_of(group.scenes.begin(), group.scenes.end(), [&](SummaryScene const& other) {
    return &other != &one && case_name(group, other) == case_name(group, one) && other.layout == one.layout;
  });
  return is_known ? fmt::format("{}, N = {}", name, one.finest) : name;
}

std::vector<std::string> sentences(SummaryGroup const& group) {
  std::vector<SummaryRow const*> rows;
  for (SummaryRow const& row : group.rows) {
    if (!row.is_control) rows.push_back(&row);
  }
  if (rows.empty()) return {"Only controls ran here: there is nothing to recommend."};
  std::vector<SummaryRow const*> const others(rows.begin() + 1, rows.end());
  std::vector<std::string> all{first_sentence(*rows.front(), others)};
  for (SummaryRow const* row : others) {
    std::vector<std::string> parts = troubles(*row);
    std::string const compared = against_text(row->against_first, rows.front()->said);
    if (!compared.empty()) parts.push_back(compared);
    if (parts.empty()) parts.push_back(error_text(*row));
    all.push_back(row->said + ": " + join(parts));
  }
  return all;
}

std::string summary_text(std::vector<SummaryGroup> const& groups, Comparison const& comparison) {
  CompareOptions const& options = comparison.options;
  std::string text;
  for (SummaryGroup const& group : groups)
    text += text.empty() ? in_full(group, options) : in_words(group, options);
  if (text.empty()) return text;
  bool const is_alone = !options.section.empty();
  std::string const more =
      is_alone ? "Case by case: --section series." : "Below: case by case, every setting.";
  std::string const marks = options.legend ? "" : " What the marks mean: --legend.";
  bool const is_markdown = options.style.format == TableFormat::markdown;
  return text + (is_markdown ? "\n" + more + marks + "\n" : line_of(more + marks, options.style));
}

std::vector<LegendEntry> summary_legend() {
  return {
      {"",
       "The answer: a scene is a case on a layout. Each formulation stands at the one setting with which it "
       "fails on the fewest scenes, then diverges on the fewest, then has the smallest error."},
      {"error", "at the finest level, relative to the exact field, geometric mean of the scenes"},
      {"order, floor",
       "the lowest order (none if some scene has none), the highest floor: of which scene, stands below"},
      {"<", "a floor that may be none"},
      {"wall flux, wall impulse, energy made", "the worst scene"},
      {"1% after", "run time to 1% error on the slowest scene, or the N at which the law gets there"},
      {"",
       "Orders have 95% intervals, as floors do: 0.4 (0.2-1.9) is one whose ends are uneven. Errors are told "
       "apart where they differ by more than "
       "their intervals: of the seeds, of time stepping, of rounding."}};
}

}  // namespace sphverify
