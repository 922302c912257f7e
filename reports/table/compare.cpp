#include "reports/table/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "reports/json/results_json.hpp"
#include "reports/table/series_row.hpp"
#include "reports/table/time_ratio.hpp"

namespace sphverify {

namespace {

/// 4.9e-3: short enough for a column each.
std::string scientific(Number const& value) {
  if (!value) return "-";
  if (!std::isfinite(*value)) return "fails";
  if (*value == 0.0) return "0";
  int exponent = static_cast<int>(std::floor(std::log10(std::abs(*value))));
  double mantissa = *value / std::pow(10.0, exponent);
  if (std::abs(mantissa) >= 9.95) {  // would be rounded to 10.0
    mantissa /= 10.0;
    ++exponent;
  }
  return fmt::format("{:.1f}e{}", mantissa, exponent);
}

std::string percent(Number const& value) {
  if (!value) return "-";
  double const hundredths = 100.0 * *value;
  if (hundredths < 1e-9) return "0%";  // rounding
  if (hundredths >= 10000.0) return scientific(hundredths) + "%";
  return hundredths >= 10.0 ? fmt::format("{:.0f}%", hundredths) : fmt::format("{:.2g}%", hundredths);
}

std::string layout_name(LayoutChoice const& layout) {
  if (layout.id == "jittered") return fmt::format("jitter {:g}", layout.amplitude);
  bool const has_distance = layout.id == "clumped" || layout.id == "touching";
  return has_distance ? fmt::format("{} {:g}", layout.id, layout.amplitude) : layout.id;
}

/// "brookshaw" for "conduction/brookshaw", "total" for "work/total-energy".
std::string without_room(std::string const& id) {
  std::string name = id.substr(id.find('/') + 1);
  std::string const energy = "-energy";
  if (name.ends_with(energy)) name.erase(name.size() - energy.size());
  return name;
}

/// The name of a row's formulation among others: a partner is named only where the form has several of its
/// kind.
std::string short_name(SeriesRow const& row, std::vector<SeriesRow> const& rows) {
  std::string name = without_room(row.choice.id);
  for (std::string FormulationChoice::*const partner :
       {&FormulationChoice::work, &FormulationChoice::conduction}) {
    std::string const& mine = row.choice.*partner;
    bool const has_several = std::any_of(rows.begin(), rows.end(), [&](SeriesRow const& other) {
      std::string const& theirs = other.choice.*partner;
      return other.choice.id == row.choice.id && !theirs.empty() && theirs != mine;
    });
    if (!mine.empty() && has_several) name += " + " + without_room(mine);
  }
  return row.walls ? name : name + " (off)";
}

std::string viscosity_name(ViscosityChoice const& v) {
  return v == ViscosityChoice{} ? "off" : fmt::format("{:g} {:g}", v.alpha, v.beta);
}

/// Which of a discretisation's choices differ between the rows, and so must be named.
struct Varying {
  bool density, face_weight, closure, wall_motion, integrator, smoothing, viscosity, ratio, document;

  explicit Varying(std::vector<SeriesRow> const& rows) {
    auto const varies = [&](auto const& key) {
      return std::any_of(rows.begin(), rows.end(),
                         [&](SeriesRow const& r) { return key(r) != key(rows.front()); });
    };
    density = varies([](SeriesRow const& r) { return r.discretisation.density; });
    // Without wall terms the two have no meaning.
    auto const with_walls = [&](auto const& key) {
      SeriesRow const* first = nullptr;
      for (SeriesRow const& r : rows) {
        if (!r.walls) continue;
        if (first == nullptr) first = &r;
        if (key(r) != key(*first)) return true;
      }
      return false;
    };
    face_weight = with_walls([](SeriesRow const& r) { return r.discretisation.face_weight; });
    closure = with_walls([](SeriesRow const& r) { return r.discretisation.closure; });
    wall_motion = with_walls([](SeriesRow const& r) { return r.discretisation.wall_motion; });
    integrator = varies([](SeriesRow const& r) { return r.discretisation.integrator; });
    smoothing = varies([](SeriesRow const& r) { return r.discretisation.smoothing; });
    viscosity = varies([](SeriesRow const& r) { return viscosity_name(r.discretisation.viscosity); });
    ratio = varies([](SeriesRow const& r) { return r.discretisation.smoothing_ratio; });
    document = varies([](SeriesRow const& r) { return r.document; });
  }
};

/// What a row of a pivot stands for: formulation and the choices that differ.
std::vector<std::string> row_key(SeriesRow const& row, std::vector<SeriesRow> const& rows,
                                 Varying const& varying) {
  std::vector<std::string> key{short_name(row, rows)};
  if (varying.density) key.push_back(row.discretisation.density);
  if (varying.face_weight) key.push_back(row.walls ? row.discretisation.face_weight : "");
  if (varying.closure) key.push_back(row.walls ? row.discretisation.closure : "");
  if (varying.wall_motion) key.push_back(row.walls ? row.discretisation.wall_motion : "");
  if (varying.integrator) key.push_back(row.discretisation.integrator);
  if (varying.smoothing) key.push_back(row.discretisation.smoothing);
  if (varying.viscosity) key.push_back(viscosity_name(row.discretisation.viscosity));
  if (varying.document) key.push_back(row.document);
  return key;
}

std::vector<std::string> row_header(Varying const& varying) {
  std::vector<std::string> header{"formulation"};
  if (varying.density) header.emplace_back("density");
  if (varying.face_weight) header.emplace_back("face weight");
  if (varying.closure) header.emplace_back("closure");
  if (varying.wall_motion) header.emplace_back("wall motion");
  if (varying.integrator) header.emplace_back("integrator");
  if (varying.smoothing) header.emplace_back("smoothing");
  if (varying.viscosity) header.emplace_back("viscosity");
  if (varying.document) header.emplace_back("results");
  return header;
}

/// What a column of a pivot stands for: layout and refinement path.
std::string column_key(SeriesRow const& row, Varying const& varying) {
  std::string key = layout_name(row.discretisation.layout);
  if (varying.ratio) key += fmt::format(" {:g}", row.discretisation.smoothing_ratio);
  if (row.smoothing_exponent != 0.0) key += fmt::format(" q={:g}", row.smoothing_exponent);
  return key;
}

struct Cell {
  std::string text;
  Number value;  ///< by which the best is found; the lower the better
};

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
  auto const signed_percent = [](double value) {
    return std::abs(value) < 0.1 ? fmt::format("{:+.2g}%", 100.0 * value)
                                 : fmt::format("{:+.0f}%", 100.0 * value);
  };
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

TextTable pivot(std::string const& title, std::vector<SeriesRow> const& rows,
                std::function<Cell(SeriesRow const&)> const& cell_of) {
  Varying const varying(rows);
  TextTable table;
  table.title = title;
  table.header = row_header(varying);
  table.label_columns = table.header.size();
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> keys;
  for (SeriesRow const& row : rows) {
    if (std::string const c = column_key(row, varying);
        std::find(columns.begin(), columns.end(), c) == columns.end()) {
      columns.push_back(c);
    }
    if (auto const k = row_key(row, rows, varying); std::find(keys.begin(), keys.end(), k) == keys.end())
      keys.push_back(k);
  }
  table.header.insert(table.header.end(), columns.begin(), columns.end());
  std::vector<Number> best(columns.size());
  std::vector<std::vector<Number>> values;
  for (auto const& key : keys) {
    std::vector<std::string> cells = key;
    std::vector<Number> row_values;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      Cell cell{"", std::nullopt};
      for (SeriesRow const& row : rows) {
        if (row_key(row, rows, varying) == key && column_key(row, varying) == columns[c]) cell = cell_of(row);
      }
      cells.push_back(cell.text);
      row_values.push_back(cell.value);
      if (cell.value && (!best[c] || *cell.value < *best[c])) best[c] = cell.value;
    }
    table.rows.push_back(std::move(cells));
    values.push_back(std::move(row_values));
  }
  for (auto const& row : values) {
    std::vector<bool> marks(table.label_columns, false);
    for (std::size_t c = 0; c < columns.size(); ++c)
      marks.push_back(keys.size() > 1 && row[c] && row[c] == best[c]);
    table.best.push_back(std::move(marks));
  }
  return table;
}

/// Over everything that was run: how often each formulation converged, and how near it came.
TextTable summary(std::vector<SeriesRow> const& rows, CompareOptions const& options) {
  TextTable table;
  table.title = fmt::format("Summary over all cases and discretisations ({} error, region {})",
                            options.norm.empty() ? "l1 at jumps, else l2" : options.norm, options.region);
  table.header = {"formulation", "ladders", "settled", "unsettled", "floored",
                  "diverge",     "fail",    "median",  "worst",     "wall flux"};
  std::vector<std::string> names;
  for (SeriesRow const& row : rows) {
    std::string const name = short_name(row, rows);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  auto const median = [](std::vector<double> values) -> Number {
    if (values.empty()) return std::nullopt;
    std::sort(values.begin(), values.end());
    std::size_t const n = values.size();
    return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
  };
  for (std::string const& name : names) {
    int asymptotic = 0, unsettled = 0, floored = 0, diverges = 0, fails = 0, ladders = 0;
    std::vector<double> errors, fluxes;
    for (SeriesRow const& row : rows) {
      if (short_name(row, rows) != name) continue;
      ++ladders;
      if (!row.failures.empty()) {
        ++fails;
        errors.push_back(INFINITY);  // no number is worse
        continue;
      }
      asymptotic += row.verdict == "asymptotic";
      unsettled += row.verdict == "pre-asymptotic";
      floored += row.verdict == "floored";
      diverges += row.verdict == "diverging";
      if (row.relative_error) errors.push_back(*row.relative_error);
      if (row.wall_flux_error && row.heat_crosses_walls) fluxes.push_back(*row.wall_flux_error);
    }
    table.rows.push_back(
        {name, fmt::format("{}", ladders), fmt::format("{}", asymptotic), fmt::format("{}", unsettled),
         fmt::format("{}", floored), fmt::format("{}", diverges), fmt::format("{}", fails),
         scientific(median(errors)),
         scientific(errors.empty() ? Number() : Number(*std::max_element(errors.begin(), errors.end()))),
         percent(median(fluxes))});
  }
  return table;
}

/// Words in lines of at most 98 characters, indented.
std::string wrapped(std::string const& words) {
  std::string text = " ";
  std::size_t length = 1;
  for (std::size_t start = 0; start < words.size();) {
    std::size_t const end = std::min(words.find(' ', start), words.size());
    if (length + 1 + end - start > 98) {
      text += "\n ";
      length = 1;
    }
    text += " " + words.substr(start, end - start);
    length += 1 + end - start;
    start = end + 1;
  }
  return text;
}

std::string readable(std::vector<SeriesRow> const& rows, CompareOptions const& options) {
  std::string text;
  // Errors of different fields do not compare.
  auto const table_of = [](SeriesRow const& row) {
    return std::tuple(row.case_id, row.parameters, row.field);
  };
  std::vector<std::tuple<std::string, std::string, std::string>> tables;
  for (SeriesRow const& row : rows) {
    if (std::find(tables.begin(), tables.end(), table_of(row)) == tables.end())
      tables.push_back(table_of(row));
  }
  for (auto const& table : tables) {
    auto const& [case_id, parameters, field] = table;
    std::vector<SeriesRow> chosen;
    for (SeriesRow const& row : rows) {
      if (table_of(row) == table) chosen.push_back(row);
    }
    std::string const heading = fmt::format("{}\n{}", case_id, wrapped(parameters));
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
      text +=
          render(pivot(fmt::format(
                           "{}: impulse that a wall gave in the scheme, against what it prescribes, N = {}",
                           case_id, chosen.front().finest),
                       chosen, impulse_cell),
                 options.format, options.colour) +
          "\n";
    }
    for (auto const& [percent, target] :
         {std::pair{"1%", &SeriesRow::to_percent}, {"0.1%", &SeriesRow::to_permille}}) {
      TimeTable const times(chosen, target);
      if (times.is_empty()) continue;
      text += render(pivot(fmt::format("{}: run time to {} error, fastest of its results file = 1", case_id,
                                       percent),
                           chosen, [&times](SeriesRow const& row) { return time_cell(row, times); }),
                     options.format, options.colour) +
              "\n";
    }
  }
  text += render(summary(rows, options), options.format, options.colour);
  return text +
         "\n* best of its column   (off): without wall terms   q: h/dx grows as N^q, else it is fixed\n"
         "1.2±0.1: order with 95% interval   ~1.2: order still changing   floored, diverges: no convergence\n"
         "Errors are relative to the exact field's norm (absolute where that is zero), wall fluxes to the\n"
         "largest flux; the last column is their median where heat crosses walls. settled: asymptotic\n"
         "unsettled: order still changing   short: fewer than three levels   <=: the coarsest got there\n"
         "fails: worse than any number   The rules of the verdicts: sphverify describe order\n"
         "Run times: ratios of medians with 95% interval, 1.09±0.05 or 2.4 (1.9-3.1), where repeats give\n"
         "one   *: the fastest   ~: cannot be told from it   >=: the fastest's coarsest got there\n"
         "Only times of one results file are compared.\n" +
         disturbance(rows);
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
          {"energy_routes", row.energy_routes}};
}

std::vector<std::pair<std::string, std::string>> words_of(SeriesRow const& row) {
  return {{"results", row.document},
          {"case", row.case_id},
          {"parameters", row.parameters},
          {"formulation", row.formulation},
          {"density", row.discretisation.density},
          {"layout", layout_name(row.discretisation.layout)},
          {"face_weight", row.discretisation.face_weight},
          {"closure", row.discretisation.closure},
          {"integrator", row.discretisation.integrator},
          {"wall_motion", row.discretisation.wall_motion},
          {"smoothing", row.discretisation.smoothing},
          {"viscosity", viscosity_name(row.discretisation.viscosity)},
          {"smoothing_ratio", fmt::format("{:g}", row.discretisation.smoothing_ratio)},
          {"smoothing_exponent", fmt::format("{:g}", row.smoothing_exponent)},
          {"finest", fmt::format("{}", row.finest)},
          {"field", row.field},
          {"norm", row.norm},
          {"verdict", row.verdict},
          {"failures", row.failures}};
}

std::string csv(std::vector<SeriesRow> const& rows) {
  TextTable table;
  for (auto const& [name, value] : words_of(SeriesRow{})) table.header.push_back(name);
  for (auto const& [name, value] : numbers_of(SeriesRow{})) table.header.push_back(name);
  for (SeriesRow const& row : rows) {
    std::vector<std::string> cells;
    for (auto const& [name, value] : words_of(row)) cells.push_back(value);
    for (auto const& [name, value] : numbers_of(row)) cells.push_back(value ? fmt::format("{}", *value) : "");
    table.rows.push_back(std::move(cells));
  }
  return render(table, TableFormat::csv, false);
}

std::string json(std::vector<SeriesRow> const& rows, CompareOptions const& options) {
  Json document = {{"schema", "sphverify-comparison/1"},
                   {"region", options.region},
                   {"norm", options.norm.empty() ? "auto" : options.norm},
                   {"series", Json::array()}};
  for (SeriesRow const& row : rows) {
    Json entry;
    for (auto const& [name, value] : words_of(row)) entry[name] = value;
    for (auto const& [name, value] : numbers_of(row)) entry[name] = value ? Json(*value) : Json(nullptr);
    document["series"].push_back(std::move(entry));
  }
  return document_text(document);
}

}  // namespace

std::string compare(std::vector<NamedResults> const& documents, CompareOptions const& options) {
  auto const rows = series_rows(documents, options.region, options.norm);
  if (options.format == TableFormat::csv) return csv(rows);
  if (options.format == TableFormat::json) return json(rows, options);
  if (rows.empty()) return "No series: the study ran nothing.\n";
  return readable(rows, options);
}

}  // namespace sphverify
