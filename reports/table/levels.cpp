// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "reports/table/number_text.hpp"

namespace sphverify {

namespace {

/// A number that is none is not written.
Number finite(double value) { return std::isfinite(value) ? Number(value) : Number(); }

LevelRow row_of_run(std::string const& document, RunRecord const& run) {
  LevelRow row;
  row.document = document;
  row.choice = run.formulation;
  row.discretisation = run.discretisation;
  row.smoothing_exponent = run.smoothing_exponent;
  row.case_id = run.case_id;
  row.parameters = parameters_text(run.parameters);
  row.formulation = run.formulation.id;
  row.label = run.label;
  row.status = run.status;
  row.resolution = run.resolution;
  row.particles = run.particles;
  row.spacing = finite(run.spacing);  // of a run that never began it is none
  row.smoothing_length = finite(run.smoothing_length);
  if (run.cost) row.seconds = finite(run.cost->seconds);
  return row;
}

/// Of every run the coarsest resolution of its ladder.
std::vector<int> first_resolutions(Results const& results) {
  std::vector<int> first(results.runs.size(), 0);
  for (Series const& series : results.series) {
    int coarsest = std::numeric_limits<int>::max();
    for (std::size_t const run : series.runs) coarsest = std::min(coarsest, results.runs[run].resolution);
    for (std::size_t const run : series.runs) first[run] = coarsest;
  }
  return first;
}

void add_error(LevelRow& row, RegionError const& error) {
  row.l1 = finite(error.error.l1);
  row.l2 = finite(error.error.l2);
  row.linf = finite(error.error.linf);
  row.scale_l1 = finite(error.scale.l1);
  row.scale_l2 = finite(error.scale.l2);
  row.scale_linf = finite(error.scale.linf);
  if (error.initial) {
    row.initial_l1 = finite(error.initial->l1);
    row.initial_l2 = finite(error.initial->l2);
    row.initial_linf = finite(error.initial->linf);
  }
  if (error.mean) row.mean = finite(*error.mean);
  row.round_off = finite(error.round_off);
}

/// Commas and quotation marks would need a reader that knows of quoting.
std::string plain(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::replace(text.begin(), text.end(), '"', '\'');
  std::string single;
  for (char const c : text) {
    if (c != ' ' || !single.ends_with(' ')) single += c;
  }
  return single;
}

Number whole(std::size_t n) { return static_cast<double>(n); }

std::vector<std::pair<std::string, std::string>> words_of(LevelRow const& row) {
  std::vector<std::pair<std::string, std::string>> words{
      {"results", plain(row.document)},      {"case", row.case_id},
      {"parameters", plain(row.parameters)}, {"label", row.label},
      {"formulation", row.formulation},      {"work", row.choice.work},
      {"conduction", row.choice.conduction}, {"walls", row.choice.walls.word}};
  for (auto& choice : setting_words(row)) {
    // Numbers of a program's own are numbers here.
    if (choice.first != "smoothing_ratio" && choice.first != "smoothing_exponent")
      words.push_back(std::move(choice));
  }
  words.insert(words.end(), {{"status", row.status}, {"field", row.field}, {"region", row.region}});
  return words;
}

std::vector<std::pair<std::string, Number>> numbers_of(LevelRow const& row) {
  bool const has_seed = is_drawn(row.discretisation.layout);
  return {{"smoothing_ratio", row.discretisation.smoothing_ratio},
          {"smoothing_exponent", row.smoothing_exponent},
          {"seed", has_seed ? Number(static_cast<double>(row.discretisation.layout.seed)) : Number()},
          {"N", static_cast<double>(row.resolution)},
          {"particles", whole(row.particles)},
          {"spacing", row.spacing},
          {"smoothing_length", row.smoothing_length},
          {"l1", row.l1},
          {"l2", row.l2},
          {"linf", row.linf},
          {"scale_l1", row.scale_l1},
          {"scale_l2", row.scale_l2},
          {"scale_linf", row.scale_linf},
          {"initial_l1", row.initial_l1},
          {"initial_l2", row.initial_l2},
          {"initial_linf", row.initial_linf},
          {"mean", row.mean},
          {"round_off", row.round_off},
          {"seconds", row.seconds}};
}

/// What one table shows.
auto key_of(LevelRow const& row) {
  return std::tuple(row.case_id, row.parameters, row.field, row.region,
                    layout_name(row.discretisation.layout), smoothing_text(row));
}

TextTable table_of(std::vector<LevelRow> const& rows) {
  LevelRow const& first = rows.front();
  SettingNames const names({rows.begin(), rows.end()});
  bool const has_seeds = std::any_of(rows.begin(), rows.end(),
                                     [](LevelRow const& r) { return is_drawn(r.discretisation.layout); });
  TextTable table;
  std::string const heading =
      first.parameters.empty() ? first.case_id : fmt::format("{}\n  {}", first.case_id, first.parameters);
  std::string const where =
      fmt::format("{}, {}", layout_name(first.discretisation.layout), smoothing_text(first));
  table.title = first.field.empty() ? fmt::format("{}\nRuns without an error; {}", heading, where)
                                    : fmt::format("{}\nError of {}, region {}; {}", heading, first.field,
                                                  first.region, where);
  table.header = names.header();
  if (has_seeds) table.header.emplace_back("seed");
  table.header.emplace_back("N");
  table.label_columns = table.header.size();
  for (char const* name :
       {"l1", "l2", "linf", "l2 of nothing done", "mean", "l2 of the exact field", "status"})
    table.header.emplace_back(name);
  for (LevelRow const& row : rows) {
    auto& cells = table.rows.emplace_back(names.row(row));
    bool const is_seeded = is_drawn(row.discretisation.layout);
    if (has_seeds) cells.push_back(is_seeded ? fmt::format("{}", row.discretisation.layout.seed) : "");
    cells.push_back(fmt::format("{}", row.resolution));
    for (Number const& value : {row.l1, row.l2, row.linf, row.initial_l2, row.mean, row.scale_l2})
      cells.push_back(scientific(value));
    cells.push_back(row.status);
  }
  return table;
}

}  // namespace

std::vector<LevelRow> level_rows(std::vector<NamedResults> const& documents) {
  std::vector<LevelRow> rows;
  for (NamedResults const& document : documents) {
    std::vector<RunRecord> const& runs = document.results.runs;
    std::vector<int> const first = first_resolutions(document.results);
    for (std::size_t k = 0; k < runs.size(); ++k) {
      RunRecord const& run = runs[k];
      LevelRow of_run = row_of_run(document.name, run);
      of_run.first_resolution = first[k];
      if (run.errors.empty()) rows.push_back(of_run);
      for (auto const& [field, regions] : run.errors) {
        for (auto const& [region, error] : regions) {
          LevelRow& row = rows.emplace_back(of_run);
          row.field = field;
          row.region = region;
          add_error(row, error);
        }
      }
    }
  }
  return rows;
}

std::string levels_text(std::vector<LevelRow> const& rows, TextStyle const& style) {
  std::string text;
  std::vector<bool> is_done(rows.size(), false);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (is_done[k]) continue;
    std::vector<LevelRow> chosen;
    for (std::size_t other = k; other < rows.size(); ++other) {
      if (key_of(rows[other]) != key_of(rows[k])) continue;
      chosen.push_back(rows[other]);
      is_done[other] = true;
    }
    text += (text.empty() ? "" : "\n") + render(table_of(chosen), style);
  }
  return text;
}

std::vector<LegendEntry> levels_legend() {
  return {{"",
           "Errors are absolute, a run each. Nothing done: the initial state taken for the answer. The mean "
           "is that of computed - exact, with its sign."}};
}

std::string levels_csv(std::vector<LevelRow> const& rows) {
  TextTable table;
  for (auto const& [name, value] : words_of(LevelRow{})) table.header.push_back(name);
  for (auto const& [name, value] : numbers_of(LevelRow{})) table.header.push_back(name);
  for (LevelRow const& row : rows) {
    auto& cells = table.rows.emplace_back();
    for (auto& [name, value] : words_of(row)) cells.push_back(std::move(value));
    for (auto const& [name, value] : numbers_of(row)) cells.push_back(value ? fmt::format("{}", *value) : "");
  }
  return render(table, {TableFormat::csv});
}

Json levels_json(std::vector<LevelRow> const& rows) {
  Json all = Json::array();
  for (LevelRow const& row : rows) {
    Json entry;
    for (auto const& [name, value] : words_of(row)) entry[name] = value;
    for (auto const& [name, value] : numbers_of(row)) entry[name] = value ? Json(*value) : Json(nullptr);
    all.push_back(std::move(entry));
  }
  return all;
}

}  // namespace sphverify
