// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/surface_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <tuple>

#include "reports/json/surface_json.hpp"
#include "reports/leading_fields.hpp"
#include "reports/table/legend.hpp"
#include "reports/table/number_text.hpp"
#include "reports/table/surface_advice.hpp"

namespace sphverify {

namespace {

using Rows = std::vector<SurfaceRow const*>;

std::string plain(Number const& value) { return value ? fmt::format("{:.3g}", *value) : "-"; }

/// 2.1 (1.9-2.4), with "to" where an end is negative; a range of one number is not shown.
std::string with_interval(Estimate const& e, int digits = 2) {
  if (!e.value) return "-";
  auto const text = [digits](double value) {
    bool const is_long = value >= 10.0 && value < 1e5;  // 130, not 1.3e+02
    return is_long ? fmt::format("{:.0f}", value) : fmt::format("{:.{}g}", value, digits);
  };
  std::string const value = text(*e.value);
  if (!e.lower || !e.upper || *e.lower == *e.upper) return value;
  return fmt::format("{} ({}{}{})", value, text(*e.lower), *e.lower < 0.0 ? " to " : "-", text(*e.upper));
}

std::string ratio_cell(BestRatio const& best) {
  if (!best.ratio.value) return "-";
  char const* const beyond = best.edge == "lower" ? "<= " : best.edge == "upper" ? ">= " : "";
  return beyond + with_interval(best.ratio, 3);
}

BestRatio const* best_at(SurfaceRow const& row, int resolution) {
  auto const& all = row.surface.error.best;
  auto const found =
      std::find_if(all.begin(), all.end(), [&](BestRatio const& b) { return b.resolution == resolution; });
  return found == all.end() ? nullptr : &*found;
}

SurfacePath const* path_in(SurfaceRow const& row, std::string const& unit) {
  auto const& all = row.surface.error.paths;
  auto const found = std::find_if(
      all.begin(), all.end(), [&](SurfacePath const& p) { return p.cost.unit == unit && !p.points.empty(); });
  return found == all.end() ? nullptr : &*found;
}

PathRule const* rule_of(SurfacePath const* path, double exponent) {
  if (path == nullptr) return nullptr;
  auto const found = std::find_if(path->rules.begin(), path->rules.end(),
                                  [&](PathRule const& r) { return r.exponent == exponent; });
  return found == path->rules.end() ? nullptr : &*found;
}

std::string name_of(SettingNames const& names, SurfaceRow const& row) {
  std::vector<std::string> parts = names.row(row);
  parts.push_back(names.column(row));
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// "1.5 (1.4-1.6) at N = 25", with what was measured where that is to be taken, or says otherwise.
std::string advice_text(ErrorSurface const& surface, BestRatio const& best) {
  std::string const at = fmt::format(" at N = {}", best.resolution);
  std::string const law = ratio_cell(best);
  std::string const measured = plain(best.grid_ratio);
  switch (advice_at(surface, best)) {
    case SurfaceAdvice::law:
      return law + at;
    case SurfaceAdvice::measured:
      return fmt::format("{}{} (measured; by the law {}, within its misfit of {})", measured, at, law,
                         percent(std::expm1(surface.misfit.value_or(0.0))));
    case SurfaceAdvice::untried:
      return fmt::format("{}{} (measured; by the law {}, where no error counts)", measured, at, law);
    case SurfaceAdvice::apart:
      break;
  }
  return fmt::format("{}{} by the law, though {} erred least of those that ran", law, at, measured);
}

/// Rows and columns without an error that counts: a run of each of their cells failed, or its error is at
/// round-off. Empty where every one has some.
std::string failed_text(ErrorSurface const& surface) {
  std::set<int> resolutions;
  std::set<double> ratios;
  for (SurfaceCell const& cell : surface.cells) {
    resolutions.insert(cell.resolution);
    ratios.insert(cell.smoothing_ratio);
  }
  for (SurfaceCell const& cell : surface.cells) {
    if (!cell.error) continue;
    resolutions.erase(cell.resolution);
    ratios.erase(cell.smoothing_ratio);
  }
  std::vector<std::string> places;
  for (int const n : resolutions) places.push_back(fmt::format("N = {}", n));
  for (double const ratio : ratios) places.push_back(fmt::format("h/dx {:.3g}", ratio));
  return places.empty()
             ? ""
             : fmt::format(". No error counts at {} (a run failed, or rounding)", fmt::join(places, ", "));
}

std::string answer_of(SurfaceRow const& row) {
  ErrorSurface const& e = row.surface.error;
  if (e.best.empty()) return "no error counts (a run of each cell failed, or rounding)";
  BestRatio const& coarse = e.best.front();
  BestRatio const& fine = e.best.back();
  if (!e.law) {
    return fmt::format("of the grid h/dx {} at N = {} and {} at N = {}; {}", plain(coarse.grid_ratio),
                       coarse.resolution, plain(fine.grid_ratio), fine.resolution, e.reason) +
           failed_text(e);
  }
  std::string text = fmt::format("h/dx {}, {}", advice_text(e, coarse), advice_text(e, fine));
  if (e.neighbour_exponent.value)
    text += fmt::format("; neighbours ~ N^{}", with_interval(e.neighbour_exponent));
  SurfacePath const* const path = path_in(row, "pair_interactions");
  PathRule const* const half = rule_of(path, 0.5);
  PathRule const* const kept = rule_of(path, 0.0);
  if (half != nullptr && kept != nullptr && half->error_ratio.value && kept->error_ratio.value) {
    text += fmt::format(
        "; at the same cost N^0.5 errs {:.2g} times as much as the best path, h/dx kept at {:.3g} {:.2g} "
        "times",
        *half->error_ratio.value, kept->ratio, *kept->error_ratio.value);
  }
  return text + failed_text(e) + ".";
}

struct SurfaceColumn {
  std::string name;
  std::function<std::string(SurfaceRow const&)> cell;
};

std::string table(std::string const& title, Rows const& rows, SettingNames const& names,
                  std::vector<SurfaceColumn> const& columns, CompareOptions const& options) {
  TextTable text;
  text.title = title;
  text.header = names.header();
  text.header.emplace_back("layout");
  text.label_columns = text.header.size();
  for (SurfaceColumn const& column : columns) text.header.push_back(column.name);
  for (SurfaceRow const* row : rows) {
    std::vector<std::string> cells = names.row(*row);
    cells.push_back(names.column(*row));
    for (SurfaceColumn const& column : columns) cells.push_back(column.cell(*row));
    text.rows.push_back(std::move(cells));
  }
  return render(text, options.style) + "\n";
}

std::vector<SurfaceColumn> law_columns() {
  auto const of = [](Estimate ErrorSurface::*member) {
    return [member](SurfaceRow const& row) { return with_interval(row.surface.error.*member); };
  };
  return {{"smoothing p", of(&ErrorSurface::smoothing_exponent)},
          {"sampling s", of(&ErrorSurface::sampling_exponent)},
          {"spacing t", of(&ErrorSurface::spacing_exponent)},
          {"neighbours k", of(&ErrorSurface::neighbour_exponent)},
          {"of the grid",
           [](SurfaceRow const& row) {
             SurfacePath const* const path = path_in(row, "pair_interactions");
             return path != nullptr ? plain(path->grid_exponent) : "-";
           }},
          {"misfit", [](SurfaceRow const& row) {
             Number const misfit = row.surface.error.misfit;
             return misfit ? percent(std::expm1(*misfit)) : "-";
           }}};
}

std::vector<SurfaceColumn> rule_columns(std::string const& unit) {
  std::vector<SurfaceColumn> columns;
  for (auto const& [exponent, name] : {std::pair{0.0, "kept"}, {0.5, "N^0.5"}}) {
    auto const of = [unit, exponent = exponent](Estimate PathRule::*member) {
      return [=](SurfaceRow const& row) {
        PathRule const* const rule = rule_of(path_in(row, unit), exponent);
        return rule != nullptr ? with_interval(rule->*member) : "-";
      };
    };
    columns.push_back({std::string(name) + ": error", of(&PathRule::error_ratio)});
    columns.push_back({std::string(name) + ": cost", of(&PathRule::cost_ratio)});
    columns.push_back({"at N", [unit, exponent = exponent](SurfaceRow const& row) {
                         PathRule const* const rule = rule_of(path_in(row, unit), exponent);
                         return rule != nullptr ? fmt::format("{:.0f}", rule->resolution) : "-";
                       }});
  }
  return columns;
}

/// Start, end and what lies between, as "error: N, h/dx".
std::vector<SurfaceColumn> path_columns(std::string const& unit) {
  std::vector<SurfaceColumn> columns;
  constexpr int places = 4;
  for (int k = 0; k <= places; ++k) {
    std::string const name = k == 0 ? "start" : k == places ? "end" : "";
    columns.push_back({name, [unit, k](SurfaceRow const& row) -> std::string {
                         SurfacePath const* const path = path_in(row, unit);
                         if (path == nullptr) return "-";
                         std::size_t const last = path->points.size() - 1;
                         PathPoint const& p = path->points[(last * static_cast<std::size_t>(k)) / places];
                         return fmt::format("{}: {:.0f}, {:.3g}", scientific(p.error), p.resolution,
                                            *p.ratio.value);
                       }});
  }
  return columns;
}

std::string tables_of(Rows const& rows, CompareOptions const& options) {
  SurfaceRow const& first = *rows.front();
  ErrorSurface const& e = first.surface.error;
  std::vector<Setting> settings;
  std::set<int> resolutions;
  for (SurfaceRow const* row : rows) {
    settings.push_back(*row);
    for (BestRatio const& best : row->surface.error.best) resolutions.insert(best.resolution);
  }
  SettingNames const names(settings);
  std::string const what = fmt::format("{} error of {}, region {}", e.norm, e.field, e.region);
  std::string text = fmt::format("{}\n{}\nWhich h/dx at which N: {}\n\n", first.case_id,
                                 indented_lines(first.parameters, options.style.columns), what);
  if (options.style.format == TableFormat::markdown) text = "## " + text;
  for (SurfaceRow const* row : rows) {
    std::string const words = name_of(names, *row) + ": " + answer_of(*row);
    text += options.style.format == TableFormat::markdown
                ? "- " + words + "\n"
                : hanging_lines("  ", words, 4, options.style.columns);
  }
  text += "\n";
  std::vector<SurfaceColumn> by_law, of_grid;
  for (int const n : resolutions) {
    by_law.push_back({fmt::format("N = {}", n), [n](SurfaceRow const& row) {
                        BestRatio const* const best = best_at(row, n);
                        return best != nullptr ? ratio_cell(*best) : "-";
                      }});
    of_grid.push_back({fmt::format("N = {}", n), [n](SurfaceRow const& row) {
                         BestRatio const* const best = best_at(row, n);
                         if (best == nullptr || !best->grid_ratio) return std::string("-");
                         return fmt::format("{:.3g}: {}", *best->grid_ratio, scientific(best->grid_error));
                       }});
  }
  text += table("h/dx of least error by the law", rows, names, by_law, options);
  text += table("h/dx of least error among those that ran, and the error", rows, names, of_grid, options);
  text += table("The law: error ~ (h/dx dx)^p, (h/dx)^-s dx^t; neighbours ~ (particles)^k", rows, names,
                law_columns(), options);
  for (auto const& [unit, name] :
       {std::pair{"pair_interactions", "pair interactions"}, {"seconds", "run time"}}) {
    if (std::none_of(rows.begin(), rows.end(),
                     [&](SurfaceRow const* row) { return path_in(*row, unit) != nullptr; })) {
      continue;
    }
    text += table(fmt::format("The path of least {}, as error: N, h/dx", name), rows, names,
                  path_columns(unit), options);
    text += table(
        fmt::format("Rules beside that path: error at its {} and {} at its error, as ratios", name, name),
        rows, names, rule_columns(unit), options);
  }
  return text;
}

using Words = std::vector<std::pair<std::string, std::string>>;

Words csv_cells(SurfaceRow const& row, BestRatio const& best) {
  ErrorSurface const& e = row.surface.error;
  Words cells{{"results", row.document},
              {"case", row.case_id},
              {"parameters", row.parameters},
              {"formulation", row.formulation}};
  for (auto& choice : setting_words(row)) {
    // The one is what a row is about, the other 0.
    if (choice.first != "smoothing_ratio" && choice.first != "smoothing_exponent")
      cells.push_back(std::move(choice));
  }
  auto const number = [](Number const& value) { return value ? fmt::format("{}", *value) : ""; };
  auto const put = [&](std::string const& name, Estimate const& value) {
    cells.emplace_back(name, number(value.value));
    cells.emplace_back(name + "_low", number(value.lower));
    cells.emplace_back(name + "_high", number(value.upper));
  };
  cells.insert(cells.end(),
               {{"field", e.field}, {"norm", e.norm}, {"resolution", fmt::format("{}", best.resolution)}});
  put("smoothing_ratio", best.ratio);
  cells.insert(cells.end(), {{"edge", best.edge},
                             {"error", number(best.error)},
                             {"grid_smoothing_ratio", number(best.grid_ratio)},
                             {"grid_error", number(best.grid_error)}});
  put("smoothing_exponent", e.smoothing_exponent);
  put("sampling_exponent", e.sampling_exponent);
  put("spacing_exponent", e.spacing_exponent);
  put("neighbour_exponent", e.neighbour_exponent);
  for (std::string const unit : {"pair_interactions", "seconds"}) {
    SurfacePath const* const path = path_in(row, unit);
    for (auto const& [exponent, name] : {std::pair{0.0, "kept"}, {0.5, "half"}}) {
      PathRule const* const rule = rule_of(path, exponent);
      PathRule const known = rule != nullptr ? *rule : PathRule{};
      std::string const head = unit + "_" + name + "_";
      put(head + "error_ratio", known.error_ratio);
      put(head + "cost_ratio", known.cost_ratio);
    }
  }
  cells.insert(cells.end(), {{"misfit", number(e.misfit)}, {"model", e.model}, {"reason", e.reason}});
  return cells;
}

}  // namespace

std::vector<SurfaceRow> surface_rows(std::vector<NamedResults> const& documents) {
  std::vector<SurfaceRow> rows;
  for (NamedResults const& document : documents) {
    for (Surface const& surface : document.results.surfaces) {
      SurfaceRow& row = rows.emplace_back();
      row.document = document.name;
      row.choice = surface.formulation;
      row.discretisation = surface.discretisation;
      row.discretisation.smoothing_ratio = 1.0;
      row.case_id = surface.case_id;
      row.parameters = parameters_text(surface.parameters);
      row.formulation = surface.label;
      row.surface = surface;
    }
  }
  return rows;
}

std::string surfaces_text(std::vector<SurfaceRow> const& rows, CompareOptions const& options) {
  // Of each scene the fields that it has, to take the leading one.
  auto const scene_of = [](SurfaceRow const& row) { return std::tuple(row.case_id, row.parameters); };
  std::vector<std::pair<std::tuple<std::string, std::string>, Rows>> scenes;
  for (SurfaceRow const& row : rows) {
    auto found =
        std::find_if(scenes.begin(), scenes.end(), [&](auto const& s) { return s.first == scene_of(row); });
    if (found == scenes.end()) found = scenes.insert(scenes.end(), {scene_of(row), {}});
    found->second.push_back(&row);
  }
  std::string text;
  for (auto const& [scene, all] : scenes) {
    std::string field = all.front()->surface.error.field;
    for (auto leading = leading_fields.rbegin(); leading != leading_fields.rend(); ++leading) {
      if (std::any_of(all.begin(), all.end(),
                      [&](SurfaceRow const* row) { return row->surface.error.field == *leading; }))
        field = *leading;
    }
    Rows chosen;
    std::copy_if(all.begin(), all.end(), std::back_inserter(chosen),
                 [&](SurfaceRow const* row) { return row->surface.error.field == field; });
    text += tables_of(chosen, options);
  }
  return text;
}

std::vector<LegendEntry> surface_legend() {
  return {{"2.1 (1.9-2.4)", "with 95% interval, by a bootstrap of the residuals"},
          {"<=, >=", "the end of the grid: the best may lie beyond"},
          {"k", "(p - t)/(p + s): h/dx ~ N^k with N along an axis"},
          {"kept", "h/dx stays as the best path begins"},
          {"misfit", "what the law misses the errors by, root mean square"},
          {"",
           "Where sampling errors oscillate with h/dx the law knows those that ran only. What it is made of: "
           "docs/measures.md"}};
}

std::string surfaces_csv(std::vector<SurfaceRow> const& rows) {
  TextTable table;
  for (auto const& [name, value] : csv_cells(SurfaceRow{}, BestRatio{})) table.header.push_back(name);
  for (SurfaceRow const& row : rows) {
    for (BestRatio const& best : row.surface.error.best) {
      auto& cells = table.rows.emplace_back();
      for (auto& [name, value] : csv_cells(row, best)) cells.push_back(std::move(value));
    }
  }
  return render(table, {TableFormat::csv});
}

Json surfaces_json(std::vector<SurfaceRow> const& rows) {
  Json all = Json::array();
  for (SurfaceRow const& row : rows)
    all.push_back({{"results", row.document}, {"surface", to_json(row.surface)}});
  return all;
}

}  // namespace sphverify
