#include "reports/table/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "reports/json/results_json.hpp"
#include "reports/second_law_watched.hpp"
#include "reports/table/budget_tables.hpp"
#include "reports/table/changes_table.hpp"
#include "reports/table/envelope_table.hpp"
#include "reports/table/legend.hpp"
#include "reports/table/number_text.hpp"
#include "reports/table/pivot.hpp"
#include "reports/table/series_row.hpp"
#include "reports/table/summary_table.hpp"
#include "reports/table/time_ratio.hpp"

namespace sphverify {

namespace {

Cell error_cell(SeriesRow const& row) {
  if (!row.failures.empty()) return {row.failures, std::nullopt};
  if (!row.error) return {"-", std::nullopt};
  std::string const error = scientific(row.relative_error ? row.relative_error : row.error);
  Number const value = row.relative_error ? row.relative_error : row.error;
  if (row.verdict == "asymptotic" && row.half_width) {
    return {fmt::format("{} {:.1f}±{:.1f}", error, *row.order, *row.half_width), value};
  }
  if (row.verdict == "pre-asymptotic" && row.order)
    return {fmt::format("{} ~{:.1f}", error, *row.order), value};
  if (row.verdict == "diverging") return {error + " diverges", value};
  if (row.verdict == "not-refined") return {error + " short", value};
  return {error + " " + row.verdict, value};
}

Cell wall_flux_cell(SeriesRow const& row) {
  if (!row.failures.empty()) return {row.failures, std::nullopt};
  return {percent(row.wall_flux_error), row.wall_flux_error};
}

/// Pressure behind the shock, and what the wall has heated too much.
Cell shock_cell(SeriesRow const& row) {
  if (!row.failures.empty()) return {row.failures, std::nullopt};
  if (!row.plateau_pressure) return {"-", std::nullopt};
  std::string text = signed_percent(*row.plateau_pressure);
  if (row.wall_heating) text += " / " + signed_percent(*row.wall_heating);
  return {text, std::abs(*row.plateau_pressure)};
}

Cell impulse_cell(SeriesRow const& row) {
  if (!row.failures.empty()) return {row.failures, std::nullopt};
  if (!row.wall_impulse_defect) return {"-", std::nullopt};
  return {percent(row.wall_impulse_defect), row.wall_impulse_defect};
}

Cell time_cell(SeriesRow const& row, TimeTable const& times) {
  if (!row.failures.empty()) return {row.failures, std::nullopt};
  TimeTable::Entry const entry = times.entry(row);
  return {entry.text, entry.is_fastest ? Number(1.0) : std::nullopt};  // only the fastest may be marked
}

std::vector<LegendEntry> series_legend() {
  return {
      {"*", "best of its column"},
      {"(off)", "without wall terms"},
      {"q", "h/dx grows as N^q, else it is fixed"},
      {"1.2±0.1", "order with 95% interval"},
      {"~1.2", "order still changing"},
      {"floored, diverges", "no convergence"},
      {"short", "too few levels for an order"},
      {"settled", "asymptotic"},
      {"unsettled", "order still changing"},
      {"fails", "worse than any number"},
      {"", "The rules of the verdicts: sphverify describe order"},
      {"",
       "Errors are relative to the exact field's norm (absolute where that is zero), wall fluxes to the "
       "largest flux; the last column is their median where heat crosses walls."},
      {"",
       "Run times: ratios of medians with 95% interval, 1.09±0.05 or 2.4 (1.9-3.1), where repeats give one"},
      {"*", "the fastest"},
      {"~", "cannot be told from it"},
      {"<=", "the coarsest level got there"},
      {">=", "the fastest's coarsest level did"},
      {"", "Only times of one results file are compared."},
      {"rounding", "a budget closed as far as rounding allows"},
      {"~2e-3 of a step", "by theory alone"},
      {"none", "no step is stable"},
      {"", "What the tables show and how: docs/compare.md"}};
}

std::string readable(std::vector<SeriesRow> const& rows, CompareOptions const& options) {
  std::string text;
  // Errors of different fields, or at different resolutions, do not compare.
  auto const table_of = [](SeriesRow const& row) {
    return std::tuple(row.case_id, row.parameters, row.field, row.finest);
  };
  std::vector<std::tuple<std::string, std::string, std::string, int>> tables;
  for (SeriesRow const& row : rows) {
    if (std::find(tables.begin(), tables.end(), table_of(row)) == tables.end())
      tables.push_back(table_of(row));
  }
  for (auto const& table : tables) {
    auto const& [case_id, parameters, field, finest] = table;
    std::vector<SeriesRow> chosen;
    for (SeriesRow const& row : rows) {
      if (table_of(row) == table) chosen.push_back(row);
    }
    std::string const heading = fmt::format("{}\n{}", case_id, indented_lines(parameters));
    text += render(pivot(fmt::format("{}\n{} error of {}, region {}, N = {}: order or verdict", heading,
                                     chosen.front().norm, field, options.region, chosen.front().finest),
                         chosen, error_cell),
                   options.format, options.colour) +
            "\n";
    auto const has = [&](auto member) {
      return std::any_of(chosen.begin(), chosen.end(),
                         [&](SeriesRow const& r) { return (r.*member).has_value(); });
    };
    if (has(&SeriesRow::wall_flux_error)) {
      text += render(pivot(fmt::format("{}: error of the heat flux through the walls, N = {}", case_id,
                                       chosen.front().finest),
                           chosen, wall_flux_cell),
                     options.format, options.colour) +
              "\n";
    }
    if (has(&SeriesRow::plateau_pressure)) {
      text += render(pivot(fmt::format("{}: errors of pressure behind the shock / energy at the wall, N = {}",
                                       case_id, chosen.front().finest),
                           chosen, shock_cell),
                     options.format, options.colour) +
              "\n";
    }
    if (has(&SeriesRow::wall_impulse_defect)) {
      text += render(pivot(fmt::format("{}: impulse that a wall gave, against what it prescribes, N = {}",
                                       case_id, chosen.front().finest),
                           chosen, impulse_cell),
                     options.format, options.colour) +
              "\n";
    }
    for (TextTable const& budget : budget_tables(chosen))
      text += render(budget, options.format, options.colour) + "\n";
    for (auto const& [percent, target] :
         {std::pair{"1%", &SeriesRow::to_percent}, {"0.1%", &SeriesRow::to_permille}}) {
      TimeTable const times(chosen, target);
      if (times.is_empty()) continue;
      text += render(pivot(fmt::format("{}: run time to {} error, region {}, fastest of its file = 1",
                                       case_id, percent, options.region),
                           chosen, [&times](SeriesRow const& row) { return time_cell(row, times); }),
                     options.format, options.colour) +
              "\n";
    }
  }
  text += render(summary_table(rows, options), options.format, options.colour);
  text += "\n" + legend(series_legend(), options.format);
  std::string const disturbed = disturbance(rows);
  return disturbed.empty() ? text : text + legend({{"", disturbed}}, options.format);
}

std::vector<std::pair<std::string, Number>> numbers_of(SeriesRow const& row) {
  return {{"error", row.error},
          {"relative_error", row.relative_error},
          {"order", row.order},
          {"order_half_width", row.half_width},
          {"wall_flux_error", row.wall_flux_error},
          {"energy_drift", row.energy_drift},
          {"wall_budget_defect", row.wall_budget_defect},
          {"seconds", row.seconds},
          {"median_seconds", row.median.median},
          {"low_seconds", row.median.low},
          {"high_seconds", row.median.high},
          {"busy", row.busy},
          {"seconds_to_1_percent", row.to_percent.seconds},
          {"median_seconds_to_1_percent", row.to_percent.median.median},
          {"low_seconds_to_1_percent", row.to_percent.median.low},
          {"high_seconds_to_1_percent", row.to_percent.median.high},
          {"seconds_to_1_permille", row.to_permille.seconds},
          {"median_seconds_to_1_permille", row.to_permille.median.median},
          {"low_seconds_to_1_permille", row.to_permille.median.low},
          {"high_seconds_to_1_permille", row.to_permille.median.high},
          {"time_error_share", row.time_error_share},
          {"plateau_pressure_error", row.plateau_pressure},
          {"shock_position_error", row.shock_position_error},
          {"wall_heating", row.wall_heating},
          {"wall_impulse_defect", row.wall_impulse_defect},
          {"momentum_drift", row.momentum_drift},
          {"energy_pair_drift", row.energy_pair_drift},
          {"energy_routes", row.energy_routes},
          {"energy_rounding", row.energy_rounding},
          {"momentum_pair_drift", row.momentum_pair_drift},
          {"momentum_rounding", row.momentum_rounding}};
}

/// Of what is only measured when asked for.
void add_stability(SeriesRow const& row, std::vector<std::pair<std::string, Number>>& numbers) {
  Stability const stability = row.stability.value_or(Stability{});
  auto const count = [](std::optional<std::uint64_t> n) { return n ? Number(*n) : Number(); };
  numbers.emplace_back("spectral_abscissa", stability.spectral_abscissa);
  numbers.emplace_back("spectral_radius", stability.spectral_radius);
  numbers.emplace_back("growing_modes", count(stability.growing_modes));
  numbers.emplace_back("unseen_modes", count(stability.unseen_modes));
  for (std::string const method : stable_step_methods) {
    auto const found = stability.stable_steps.find(method);
    StableStep const step = found == stability.stable_steps.end() ? StableStep{} : found->second;
    std::string name = "stable_step_" + method;
    std::replace(name.begin(), name.end(), '-', '_');
    numbers.emplace_back(name, step.measured);
    numbers.emplace_back(name + "_theory", step.theory);
  }
  auto const size = [&](Breach SecondLaw::*breach, bool (*was_watched)(SecondLaw const&)) {
    if (!row.second_law || !was_watched(*row.second_law)) return Number();
    return Number(((*row.second_law).*breach).size);
  };
  numbers.emplace_back("overshoot", size(&SecondLaw::overshoot, watched_bounds));
  numbers.emplace_back("undershoot", size(&SecondLaw::undershoot, watched_bounds));
  numbers.emplace_back("cold_to_hot", size(&SecondLaw::cold_to_hot, watched_cold_to_hot));
  numbers.emplace_back("smallest_entropy_production",
                       row.second_law ? row.second_law->smallest_entropy_production : Number());
}

std::vector<std::pair<std::string, Number>> all_numbers_of(SeriesRow const& row) {
  auto numbers = numbers_of(row);
  add_stability(row, numbers);
  return numbers;
}

std::vector<std::pair<std::string, std::string>> words_of(SeriesRow const& row) {
  std::vector<std::pair<std::string, std::string>> words{{"results", row.document},
                                                         {"case", row.case_id},
                                                         {"parameters", row.parameters},
                                                         {"formulation", row.formulation}};
  for (auto& choice : setting_words(row)) words.push_back(std::move(choice));
  words.insert(words.end(), {{"finest", fmt::format("{}", row.finest)},
                             {"field", row.field},
                             {"norm", row.norm},
                             {"verdict", row.verdict},
                             {"failures", row.failures}});
  return words;
}

std::string series_csv(std::vector<SeriesRow> const& rows) {
  TextTable table;
  for (auto const& [name, value] : words_of(SeriesRow{})) table.header.push_back(name);
  for (auto const& [name, value] : all_numbers_of(SeriesRow{})) table.header.push_back(name);
  for (SeriesRow const& row : rows) {
    std::vector<std::string> cells;
    for (auto const& [name, value] : words_of(row)) cells.push_back(value);
    for (auto const& [name, value] : all_numbers_of(row))
      cells.push_back(value ? fmt::format("{}", *value) : "");
    table.rows.push_back(std::move(cells));
  }
  return render(table, TableFormat::csv, false);
}

Json context_json(NamedResults const& document) {
  Json json = {{"name", document.name}};
  json.update(to_json(document.results.context));
  return json;
}

std::string json(std::vector<NamedResults> const& documents, CompareOptions const& options) {
  Json document = {{"schema", "sphverify-comparison/1"},
                   {"region", options.region},
                   {"norm", options.norm.empty() ? "auto" : options.norm},
                   {"documents", Json::array()},
                   {"series", Json::array()}};
  for (NamedResults const& one : documents) document["documents"].push_back(context_json(one));
  for (SeriesRow const& row : series_rows(documents, options.region, options.norm)) {
    Json entry;
    for (auto const& [name, value] : words_of(row)) entry[name] = value;
    for (auto const& [name, value] : all_numbers_of(row)) entry[name] = value ? Json(*value) : Json(nullptr);
    document["series"].push_back(std::move(entry));
  }
  document["envelopes"] = envelopes_json(envelope_rows(documents));
  document["changes"] = changes_json(changes_of(documents, options.region, options.norm));
  return document_text(document);
}

std::string csv(std::vector<NamedResults> const& documents, CompareOptions const& options) {
  if (options.section == "changes") return changes_csv(changes_of(documents, options.region, options.norm));
  auto const rows = series_rows(documents, options.region, options.norm);
  auto const envelopes = envelope_rows(documents);
  bool const has_only_envelopes = rows.empty() && !envelopes.empty();
  if (options.section == "envelopes" || (options.section.empty() && has_only_envelopes))
    return envelopes_csv(envelopes);
  return series_csv(rows);
}

/// Sections in the order in which they are read: the last is what a terminal shows.
std::string text(std::vector<NamedResults> const& documents, CompareOptions const& options) {
  auto const is_wanted = [&](char const* section) {
    return options.section.empty() || options.section == section;
  };
  std::vector<std::string> sections;
  if (auto const rows = series_rows(documents, options.region, options.norm);
      is_wanted("series") && !rows.empty()) {
    sections.push_back(readable(rows, options));
  }
  if (auto const envelopes = envelope_rows(documents); is_wanted("envelopes") && !envelopes.empty()) {
    std::string all;
    for (TextTable const& table : envelope_tables(envelopes))
      all += render(table, options.format, options.colour) + "\n";
    sections.push_back(
        all + legend({{"*", "held furthest"}, {"", "A range is that of the seeds, the worst first."}},
                     options.format));
  }
  if (is_wanted("changes")) {
    for (Changes const& changes : changes_of(documents, options.region, options.norm))
      sections.push_back(changes_text(changes, options));
  }
  if (sections.empty()) {
    return options.section.empty() ? "No series: the study ran nothing.\n"
                                   : fmt::format("Nothing to show of {}.\n", options.section);
  }
  return fmt::format("{}", fmt::join(sections, "\n"));
}

}  // namespace

std::string compare(std::vector<NamedResults> const& documents, CompareOptions const& options) {
  if (options.format == TableFormat::csv) return csv(documents, options);
  if (options.format == TableFormat::json) return json(documents, options);
  return text(documents, options);
}

}  // namespace sphverify
