// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/compare.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <map>
#include <optional>
#include <sstream>

#include "harness/measure/series.hpp"
#include "reports/json/node.hpp"
#include "reports/table/series_row.hpp"

BOOST_AUTO_TEST_SUITE(reports_table_compare)

using namespace sphverify;

/// Four levels of a formulation on a layout and a path; the error goes down with the given order, of
/// 0 to a floor.
void add_ladder(std::vector<RunRecord>& runs, std::string const& formulation, bool walls,
                LayoutChoice const& layout, double exponent, double error, double order,
                std::string const& last_status = "ok") {
  for (int const n : {25, 50, 100, 200}) {
    RunRecord run;
    run.case_id = "conduction/slab-dirichlet";
    run.formulation.id = formulation;
    run.formulation.walls = walls;
    run.label = walls ? formulation : formulation + " (walls off)";
    run.discretisation.layout = layout;
    run.smoothing_exponent = exponent;
    run.resolution = n;
    run.spacing = 1.0 / n;
    run.cost.emplace().seconds = 1e-4 * n;
    if (n == 200 && last_status != "ok") {
      run.status = last_status;
      run.reason = "because";
    } else {
      double const power = std::pow(25.0 / n, order > 0.0 ? order : 2.0);
      double const e = error * (order > 0.0 ? power : 1.0 + power);
      run.errors["temperature"]["all"] = {{e, e, e}, {2.0, 2.0, 2.0}, 1e-15};
    }
    runs.push_back(run);
  }
}

Results made_typical() {
  Results results;
  for (char const* id : {"conduction/brookshaw", "conduction/lucy-flux", "conduction/campbell-flux"}) {
    for (bool const walls : {true, false}) {
      for (LayoutChoice const& layout : {LayoutChoice{"lattice"}, LayoutChoice{"jittered", 0.1, 1}}) {
        for (double const exponent : {0.0, 0.5}) {
          bool const best = std::string(id) == "conduction/brookshaw" && walls;
          bool const fails = std::string(id) == "conduction/campbell-flux" && layout.id == "jittered";
          add_ladder(results.runs, id, walls, layout, exponent, best ? 1e-3 : 4e-2, best ? 2.0 : 0.0,
                     fails ? "unstable" : "ok");
        }
      }
    }
  }
  results.series = build_series(results.runs);
  return results;
}

/// Judging so many ladders takes a second, which is spent once.
Results const& typical() {
  static Results const once = made_typical();
  return once;
}

/// The series, case by case; where there are none, all that there is.
std::string table_of(Results const& results, TableFormat format, bool colour = false,
                     std::size_t columns = 160) {
  CompareOptions options;
  options.style = {format, colour, columns};
  options.legend = true;
  if (!results.series.empty()) options.section = "series";
  return compare({{"r.json", results}}, options);
}

/// The same as a terminal of 80 columns shows it.
std::string narrow_table_of(Results const& results) {
  return table_of(results, TableFormat::table, false, 80);
}

std::vector<std::string> lines_of(std::string const& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::size_t width_of(std::string const& line) {
  return static_cast<std::size_t>(std::count_if(
      line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

/// The first line that starts so, blanks aside.
std::string row(std::string const& text, std::string const& start) {
  for (std::string const& line : lines_of(text)) {
    std::size_t const at = line.find(start);
    if (at != std::string::npos && at == line.find_first_not_of(" |")) return line;
  }
  return "";
}

std::size_t count(std::string const& text, char c) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), c));
}

BOOST_AUTO_TEST_CASE(the_best_of_every_column_is_marked_and_nothing_else) {
  std::string const text = table_of(typical(), TableFormat::table);
  BOOST_TEST(count(row(text, "brookshaw "), '*') == 4u, text);
  BOOST_TEST(count(row(text, "lucy-flux "), '*') == 0u, text);
}

BOOST_AUTO_TEST_CASE(errors_come_with_their_order_or_verdict) {
  std::string const text = table_of(typical(), TableFormat::table);
  BOOST_TEST(row(text, "brookshaw ").find("±") != std::string::npos, text);
  BOOST_TEST(row(text, "lucy-flux ").find("floored") != std::string::npos, text);
}

BOOST_AUTO_TEST_CASE(failures_are_shown_instead_of_numbers) {
  std::string const text = table_of(typical(), TableFormat::table);
  BOOST_TEST(row(text, "campbell-flux ").find("unstable 1/1") != std::string::npos, text);
}

BOOST_AUTO_TEST_CASE(a_typical_table_fits_into_80_columns) {
  for (std::string const& line : lines_of(narrow_table_of(typical())))
    BOOST_TEST(width_of(line) <= 80u, line);
}

BOOST_AUTO_TEST_CASE(colour_is_there_only_when_asked_for) {
  BOOST_TEST(table_of(typical(), TableFormat::table).find('\x1b') == std::string::npos);
  BOOST_TEST(table_of(typical(), TableFormat::table, true).find('\x1b') != std::string::npos);
}

BOOST_AUTO_TEST_CASE(every_row_of_a_markdown_table_has_as_many_cells_as_its_header) {
  std::size_t cells = 0;
  std::size_t rows = 0;
  for (std::string const& line : lines_of(table_of(typical(), TableFormat::markdown))) {
    if (!line.starts_with("|")) {
      cells = 0;
      continue;
    }
    if (cells == 0) cells = count(line, '|');
    BOOST_TEST(count(line, '|') == cells, line);
    ++rows;
  }
  BOOST_TEST(rows >= 8u);
}

BOOST_AUTO_TEST_CASE(csv_has_one_row_of_as_many_cells_per_series) {
  Results results = typical();
  for (Series& series : results.series) series.parameters["note"] = std::string("a, \"quoted\" word");
  auto const lines = lines_of(table_of(results, TableFormat::csv));
  BOOST_TEST(lines.size() == 1u + results.series.size());
  auto const cells = [](std::string const& line) {
    bool quoted = false;
    std::size_t commas = 0;
    for (char const c : line) {
      if (c == '"') quoted = !quoted;
      if (c == ',' && !quoted) ++commas;
    }
    BOOST_TEST(!quoted);
    return commas + 1;
  };
  for (std::string const& line : lines) BOOST_TEST(cells(line) == cells(lines[0]), line);
  BOOST_TEST(lines[0].find("verdict") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(json_has_one_entry_per_series_with_null_for_what_is_not) {
  Results const results = typical();
  Json const document = Json::parse(table_of(results, TableFormat::json));
  BOOST_TEST(document.at("series").size() == results.series.size());
  Json const& best = document.at("series")[0];
  BOOST_TEST(best.at("formulation") == "conduction/brookshaw");
  BOOST_TEST(best.at("verdict") == "asymptotic");
  BOOST_TEST(std::abs(best.at("order").get<double>() - 2.0) < 1e-6);
  BOOST_TEST(std::abs(best.at("error").get<double>() - 1e-3 / 64.0) < 1e-12);
  BOOST_TEST(std::abs(best.at("relative_error").get<double>() - 0.5e-3 / 64.0) < 1e-12);
  BOOST_TEST(best.at("wall_flux_error").is_null());
  Json const& failed = document.at("series").back();
  BOOST_TEST(failed.at("failures") == "unstable 1/1");
  BOOST_TEST(failed.at("error").is_null());
}

/// Timed often, each formulation three times as long as the one before and known to 30%.
Results timed() {
  Results results = typical();
  double factor = 1.0 / 3.0;
  std::string last;
  for (RunRecord& run : results.runs) {
    if (run.label != last) factor *= 3.0;
    last = run.label;
    double const seconds = factor * 1e-4 * run.resolution;
    run.cost->seconds = seconds;
    run.cost->median = {1.1 * seconds, seconds, 1.3 * seconds};
    run.cost->busy = 1.0;
  }
  results.series = build_series(results.runs);
  return results;
}

/// The lines from a title on, up to the next empty one.
std::string part(std::string const& text, std::string const& title) {
  std::size_t const start = text.find(title);
  return start == std::string::npos ? "" : text.substr(start, text.find("\n\n", start) - start);
}

BOOST_AUTO_TEST_CASE(run_times_are_ratios_with_their_interval_to_one_percent_and_to_a_tenth_of_it) {
  Results results = timed();
  // The relative l2 error of brookshaw goes from 5e-4 down; make it start above both targets.
  for (RunRecord& run : results.runs) {
    if (run.errors.empty()) continue;
    double const e =
        run.label == "conduction/campbell-flux" ? 0.5 : 2e-2 * std::pow(25.0 / run.resolution, 2.5);
    run.errors["temperature"]["all"] = {{e, e, e}, {1.0, 1.0, 1.0}, 1e-15};
  }
  results.series = build_series(results.runs);
  std::string const text = table_of(results, TableFormat::table);
  for (char const* title : {"run time to 1% error, region all,", "run time to 0.1% error, region all,"}) {
    std::string const table = part(text, title);
    BOOST_TEST(row(table, "brookshaw ").find("1*") != std::string::npos, table);
    BOOST_TEST(row(table, "brookshaw (walls off)").find("3.0 (2.3-3.9)") != std::string::npos, table);
    BOOST_TEST(row(table, "lucy-flux ").find("9.0 (6.9-12)") != std::string::npos, table);
  }
  for (std::string const& line : lines_of(narrow_table_of(results))) BOOST_TEST(width_of(line) <= 80u, line);
  BOOST_TEST(text.find("Disturbed") == std::string::npos);
  results.runs[0].cost->busy = 0.5;
  BOOST_TEST(table_of(results, TableFormat::table).find("Disturbed timings: 1 of 24") != std::string::npos);

  Json const document = Json::parse(table_of(results, TableFormat::json));
  Json const& first = document.at("series")[0];
  TimeToError const& percent = results.series[0].time_to_error[4];  // l2, 1%
  BOOST_TEST_REQUIRE((percent.norm == "l2" && percent.relative == 0.01));
  BOOST_TEST(first.at("seconds_to_1_percent") == *percent.seconds);
  BOOST_TEST(first.at("median_seconds_to_1_percent") == *percent.median.median);
  BOOST_TEST(first.at("low_seconds_to_1_percent") == *percent.median.low);
  BOOST_TEST(first.at("high_seconds_to_1_percent") == *percent.median.high);
  BOOST_TEST(first.at("high_seconds_to_1_permille") == *results.series[0].time_to_error[5].median.high);
  BOOST_TEST(first.at("median_seconds") == *results.runs[3].cost->median.median);
  BOOST_TEST(first.at("busy") == 0.5);
}

BOOST_AUTO_TEST_CASE(two_documents_are_told_apart) {
  CompareOptions const options;
  std::string const text = compare({{"old.json", typical()}, {"new.json", typical()}}, options);
  BOOST_TEST(text.find("old.json") != std::string::npos);
  BOOST_TEST(text.find("new.json") != std::string::npos);
}

/// `typical` with budgets: what pairs created, and what was left by rounding.
Results with_budgets(double created) {
  Results results = typical();
  for (RunRecord& run : results.runs) {
    double const pairs = run.formulation.id == "conduction/lucy-flux" ? created : 1e-17;
    run.conservation["energy"] = {1.0, 1.0, 0.0, pairs + 1e-16, pairs, {}};
  }
  results.series = build_series(results.runs);
  return results;
}

BOOST_AUTO_TEST_CASE(what_pairs_created_is_told_from_rounding) {
  std::string text = table_of(with_budgets(0.25), TableFormat::table);
  std::size_t const at = text.find("energy created by pairs");
  BOOST_REQUIRE(at != std::string::npos);
  text = text.substr(at);
  BOOST_TEST(row(text, "brookshaw ").find("rounding / rounding*") != std::string::npos, text);
  BOOST_TEST(row(text, "lucy-flux ").find("25% / rounding ") != std::string::npos, text);
  BOOST_TEST(row(text, "campbell-flux ").find("unstable 1/1") != std::string::npos, text);
  BOOST_TEST(table_of(typical(), TableFormat::table).find("energy created") == std::string::npos);
}

/// A gas of mass 1 and energy 1/2 that gained momentum; a wall prescribes an impulse of that size, or there
/// is none.
Results gas(double drift, Number prescribed) {
  RunRecord run;
  run.case_id = "hydro/uniform";
  run.formulation.id = run.label = "momentum/p-rho2";
  run.resolution = 10;
  run.spacing = 0.1;
  run.errors["velocity"]["all"] = {{1e-3, 1e-3, 1e-3}, {1.0, 1.0, 1.0}, 1e-15};
  run.conservation["mass"] = {1.0, 1.0, 0.0, 0.0, {}, {}};
  run.conservation["energy"] = {0.5, 0.5, 0.0, 0.0, 0.0, {}};
  run.momentum = {{0.0, drift, 0.0, drift, drift, {}}};
  if (prescribed) run.wall_budgets = {{{0.0}, {*prescribed}, {*prescribed}, 0.0, 0.0, 0.0}};
  Results results;
  results.runs = {run};
  results.series = build_series(results.runs);
  return results;
}

BOOST_AUTO_TEST_CASE(momentum_is_relative_to_a_wall_s_impulse_or_else_to_what_the_gas_could_have) {
  auto const shown = [](Results const& results) {
    std::string const text = table_of(results, TableFormat::table);
    return row(text.substr(text.find("momentum created")), "p-rho2 ");
  };
  BOOST_TEST(shown(gas(0.1, 0.4)).find("25%") != std::string::npos);
  BOOST_TEST(shown(gas(0.1, std::nullopt)).find("10%") != std::string::npos);  // of sqrt(2 mass energy) = 1
  BOOST_TEST(shown(gas(1e-15, 0.4)).find("rounding") != std::string::npos);
  Results upright = gas(0.1, std::nullopt);  // a wall that prescribes along y alone
  upright.runs[0].wall_budgets = {{{0.0, 0.0}, {0.0, 0.3}, {0.0, 0.4}, 0.0, 0.0, 0.0}};
  BOOST_TEST(shown(upright).find("25%") != std::string::npos);
  std::string const text = table_of(upright, TableFormat::table);
  BOOST_TEST(row(text.substr(text.find("impulse that a wall gave")), "p-rho2 ").find("25%") !=
             std::string::npos);
}

/// A shock tube's run in which every number is another one.
RunRecord run_of_a_piston() {
  RunRecord run;
  run.case_id = "hydro/piston-velocity";
  run.formulation.id = run.label = "momentum/p-rho2";
  run.resolution = 10;
  run.spacing = 0.1;
  run.errors["velocity"]["all"] = {{3e-2, 5e-2, 7e-2}, {2.0, 2.5, 4.0}, 1e-15};
  run.conservation["mass"] = {2.0, 2.0, 0.0, 0.0, {}, {}};
  run.conservation["energy"] = {4.0, 5.0, 0.7, -0.5, 0.25, -0.15};
  run.momentum = {{0.0, 0.9, 0.8, -0.06, 0.03, {}}};
  run.wall_budgets = {{{0.0}, {0.45}, {0.5}, 0.0, 0.0, 0.0}, {{1.0}, {-0.3}, {-0.4}, 0.0, 0.0, 0.0}};
  run.shocks = {{0.7, -0.011, -0.21, 0.22, 0.23}, {0.9, 0.012, 0.11, 0.12, 0.13}};
  Motion& motion = run.motion.emplace();
  motion.wall_heating = -0.31;
  motion.energy_routes = 0.41;
  run.wall_flux = {{1.0, 1.2, -0.2, 4.0}, {2.0, 1.9, 0.1, 4.0}};
  Cost& cost = run.cost.emplace();
  cost.seconds = 0.51;
  cost.median = {0.53, 0.52, 0.54};
  cost.busy = 0.95;
  cost.steps = 100;
  Stability& stability = run.stability.emplace();
  stability.spectral_abscissa = -0.61;
  stability.spectral_radius = 62.0;
  stability.growing_modes = 3;
  stability.unseen_modes = 4;
  double step = 0.0;
  for (char const* method : stable_step_methods) {
    step += 0.01;
    stability.stable_steps[method] = {step + 0.001, step, ""};
  }
  run.second_law = SecondLaw{{0.71, 0.0, {}}, {0.72, 0.0, {}}, {0.73, 0.0, {}}, -0.74, "", 5};
  run.integration.emplace().time_error_share = 0.81;
  return run;
}

// What a program reads, number by number against the document; a number that is new must be put here.
BOOST_AUTO_TEST_CASE(every_number_of_a_series_is_the_document_s) {
  Results results;
  results.runs = {run_of_a_piston()};
  results.series = build_series(results.runs);
  double const rounding = 64.0 * std::numeric_limits<double>::epsilon() * 10.0;  // the root of 100 steps
  std::map<std::string, std::optional<double>> expected{
      {"error", 3e-2},  // l1, as the solution jumps
      {"relative_error", 1.5e-2},
      {"wall_flux_error", 0.05},     // 0.2 of 4
      {"energy_drift", 0.1},         // 0.5 of 5
      {"wall_budget_defect", 0.03},  // 0.15 of 5
      {"energy_pair_drift", 0.05},   // 0.25 of 5
      {"energy_rounding", rounding},
      {"momentum_drift", -0.12},  // of the largest impulse that a wall prescribes, 0.5
      {"momentum_pair_drift", 0.06},
      {"momentum_rounding", rounding * 4.0 / 0.5},  // of sqrt(2 x 2 x 4), over 0.5
      {"wall_impulse_defect", 0.2},                 // 0.1 of 0.5
      {"seconds", 0.51},
      {"median_seconds", 0.53},
      {"low_seconds", 0.52},
      {"high_seconds", 0.54},
      {"busy", 0.95},
      {"time_error_share", 0.81},
      {"plateau_pressure_error", -0.21},  // the worse of two
      {"shock_position_error", 0.012},
      {"wall_heating", -0.31},
      {"energy_routes", 0.41},
      {"spectral_abscissa", -0.61},
      {"spectral_radius", 62.0},
      {"growing_modes", 3.0},
      {"unseen_modes", 4.0},
      {"stable_step_explicit_euler", 0.01},
      {"stable_step_explicit_euler_theory", 0.011},
      {"stable_step_heun", 0.02},
      {"stable_step_heun_theory", 0.021},
      {"stable_step_classical_runge_kutta", 0.03},
      {"stable_step_classical_runge_kutta_theory", 0.031},
      {"stable_step_runge_kutta", 0.04},
      {"stable_step_runge_kutta_theory", 0.041},
      {"stable_step_leapfrog", 0.05},
      {"stable_step_leapfrog_theory", 0.051},
      {"overshoot", 0.71},
      {"undershoot", 0.72},
      {"cold_to_hot", 0.73},
      {"smallest_entropy_production", -0.74}};
  // One level tells no order, no floor and no time to an error that it has not reached.
  for (char const* name :
       {"order", "order_half_width", "order_low", "order_high", "floor", "floor_low", "floor_high",
        "resolution_of_1_percent", "seconds_to_1_percent", "median_seconds_to_1_percent",
        "low_seconds_to_1_percent", "high_seconds_to_1_percent", "seconds_to_1_permille",
        "median_seconds_to_1_permille", "low_seconds_to_1_permille", "high_seconds_to_1_permille"})
    expected[name] = std::nullopt;
  Json const entry = Json::parse(table_of(results, TableFormat::json)).at("series")[0];
  auto const cells_of = [](std::string const& line) {
    std::vector<std::string> cells{""};
    for (char const c : line) {
      if (c == ',') {
        cells.emplace_back();
      } else {
        cells.back() += c;
      }
    }
    return cells;
  };
  auto const lines = lines_of(table_of(results, TableFormat::csv));
  auto const names = cells_of(lines.at(0)), cells = cells_of(lines.at(1));
  BOOST_TEST_REQUIRE(names.size() == cells.size());
  for (auto const& [name, value] : entry.items()) {
    if (value.is_string()) continue;
    BOOST_TEST_CONTEXT(name) {
      BOOST_TEST_REQUIRE(expected.contains(name), "a new number");
      BOOST_TEST_REQUIRE(value.is_null() == !expected[name].has_value());
      if (!value.is_null())
        BOOST_TEST(value.get<double>() == *expected[name], boost::test_tools::tolerance(1e-12));
      auto const column = std::find(names.begin(), names.end(), name);
      BOOST_TEST_REQUIRE((column != names.end()));
      std::string const& cell = cells[static_cast<std::size_t>(column - names.begin())];
      BOOST_TEST_REQUIRE(cell.empty() == value.is_null());
      if (!value.is_null()) BOOST_TEST(std::stod(cell) == value.get<double>());
      expected.erase(name);
    }
  }
  for (auto const& [name, value] : expected) BOOST_TEST_ERROR(name << " is not in the document");
}

BOOST_AUTO_TEST_CASE(the_best_behind_a_shock_is_the_nearest_from_either_side) {
  Results results;
  for (auto const& [id, error] : {std::pair{"momentum/p-rho2", -0.21}, {"momentum/sqrt-p", 0.11}}) {
    RunRecord run = run_of_a_piston();
    run.formulation.id = run.label = id;
    run.shocks = {{0.7, 0.0, error, 0.0, 0.0}};
    results.runs.push_back(run);
  }
  results.series = build_series(results.runs);
  std::string const text = table_of(results, TableFormat::table);
  std::string const shocks = text.substr(text.find("behind the shock"));
  BOOST_TEST(row(shocks, "sqrt-p ").find("*") != std::string::npos, shocks);
  BOOST_TEST(row(shocks, "p-rho2 ").find("*") == std::string::npos, shocks);
  // What reads alike is marked alike, whatever its last digits say.
  RunRecord third = results.runs.back();
  third.formulation.id = third.label = "momentum/direct-gradient";
  third.shocks = {{0.7, 0.0, -0.1104, 0.0, 0.0}};
  results.runs.push_back(third);
  results.series = build_series(results.runs);
  std::string const three = table_of(results, TableFormat::table);
  std::string const alike = three.substr(three.find("behind the shock"));
  for (char const* id : {"sqrt-p ", "direct-gradient "})
    BOOST_TEST(row(alike, id).find("*") != std::string::npos, alike);
}

BOOST_AUTO_TEST_CASE(that_no_mode_grows_has_to_be_known_of_every_seed) {
  auto const growing = [](std::optional<std::uint64_t> known, bool other_was_looked_at) {
    std::vector<RunRecord> runs;
    add_ladder(runs, "conduction/brookshaw", true, {"jittered", 0.1, 1}, 0.0, 1e-3, 2.0);
    add_ladder(runs, "conduction/brookshaw", true, {"jittered", 0.1, 2}, 0.0, 1e-3, 2.0);
    for (RunRecord& run : runs) {
      bool const is_first = run.discretisation.layout.seed == 1;
      if (!is_first && !other_was_looked_at) continue;
      Stability& stability = run.stability.emplace();
      if (!is_first) continue;
      stability.growing_modes = known;
      stability.spectral_radius = 100.0;
      stability.stable_steps["heun"] = {0.02, 0.021, ""};
    }
    NamedResults document{"r.json", {}};
    document.results.runs = runs;
    document.results.series = build_series(runs);
    SeriesRow const row = series_row(document, document.results.series.at(0), "all", "");
    BOOST_TEST_REQUIRE(row.stability.has_value());
    BOOST_TEST(!row.stability->spectral_radius.has_value());
    BOOST_TEST(!row.stability->stable_steps.contains("heun"));
    return row.stability->growing_modes;
  };
  for (bool const was_looked_at : {true, false}) {
    BOOST_TEST(!growing(0, was_looked_at).has_value());
    BOOST_TEST(*growing(3, was_looked_at) == 3u);
  }
}

BOOST_AUTO_TEST_CASE(stability_and_the_second_law_show_the_worst_of_the_seeds) {
  Results results;
  for (std::uint64_t const seed : {1u, 2u}) {
    add_ladder(results.runs, "conduction/lucy-flux", true, {"jittered", 0.1, seed}, 0.0, 1e-3, 2.0);
    RunRecord& run = results.runs.back();
    double const size = static_cast<double>(seed);
    Stability& stability = run.stability.emplace();
    stability.spectral_abscissa = -1.0 / size;
    stability.spectral_radius = 100.0;
    stability.growing_modes = seed - 1;
    stability.stable_steps["heun"] = {0.02 / size, 0.021 / size, ""};
    stability.stable_steps["explicit-euler"] = {std::nullopt, std::nullopt,
                                                "no step is stable: a mode grows"};
    run.second_law = SecondLaw{{0.0, 0.0, {}}, {0.0, 0.0, {}}, {0.1 * size, 0.0, {}}, -0.3 * size, ""};
  }
  results.series = build_series(results.runs);
  std::string const text = table_of(results, TableFormat::table);
  std::string const modes = text.substr(text.find("modes of the linearised rate"));
  BOOST_TEST(row(modes, "lucy-flux ").find("1        -       -5.0e-1") != std::string::npos, modes);
  std::string const steps = text.substr(text.find("longest stable step"));
  BOOST_TEST(row(steps, "lucy-flux ").find("none            1.1e-2") != std::string::npos, steps);
  BOOST_TEST(steps.find("leapfrog") == std::string::npos, steps);
  std::string const law = text.substr(text.find("second law"));
  BOOST_TEST(row(law, "lucy-flux ").find("20%") != std::string::npos, law);
  BOOST_TEST(row(law, "lucy-flux ").find("-60%") != std::string::npos, law);
  Json const entry = Json::parse(table_of(results, TableFormat::json)).at("series")[0];
  BOOST_TEST(entry.at("stable_step_heun") == 0.0105);
  BOOST_TEST(entry.at("stable_step_explicit_euler").is_null());
  BOOST_TEST(entry.at("growing_modes") == 1);
  BOOST_TEST(entry.at("cold_to_hot") == 0.2);
}

BOOST_AUTO_TEST_CASE(tables_of_many_layouts_fit_into_80_columns) {
  Results results;
  for (double const amplitude : {0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4}) {
    for (double const exponent : {0.0, 0.25, 0.5})
      add_ladder(results.runs, "conduction/brookshaw", true, {"jittered", amplitude, 1}, exponent, 1e-3, 2.0);
  }
  results.series = build_series(results.runs);
  std::string const text = narrow_table_of(results);
  for (std::string const& line : lines_of(text)) BOOST_TEST(width_of(line) <= 80u, line);
  BOOST_TEST(text.find("jitter 0.4,") != std::string::npos);
  BOOST_TEST(text.find("(N/25)^0.25") != std::string::npos);
}

std::string changes_from(Results const& before, Results const& after, TableFormat format) {
  CompareOptions options;
  options.style.format = format;
  options.section = "changes";
  return compare({{"before", before}, {"after", after}}, options);
}

BOOST_AUTO_TEST_CASE(what_changed_is_counted_and_listed_from_the_largest_within_80_columns) {
  Results after = typical();
  for (RunRecord& run : after.runs) {
    if (run.formulation.id != "conduction/lucy-flux" || run.resolution != 200) continue;
    NormSet& e = run.errors["temperature"]["all"].error;
    e.l2 *= run.smoothing_exponent == 0.0 ? 4.0 : 1.5;
  }
  after.series = build_series(after.runs);
  std::string const text = changes_from(typical(), after, TableFormat::table);
  for (std::string const& line : lines_of(text)) BOOST_TEST(width_of(line) <= 80u, line);
  BOOST_TEST(text.find("What changed: after against before") != std::string::npos);
  BOOST_TEST(text.find("24 series in both") != std::string::npos, text);
  std::size_t const largest = text.find("x4");
  std::size_t const smaller = text.find("+50%");
  BOOST_TEST(largest != std::string::npos, text);
  BOOST_TEST(largest < smaller);
  BOOST_TEST(text.find("lucy-flux (walls off)") != std::string::npos);
  BOOST_TEST(changes_from(typical(), typical(), TableFormat::table).find("Nothing changed beyond noise") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(long_lists_of_changes_are_cut_on_a_terminal_and_whole_for_programs) {
  Results after = typical();
  for (RunRecord& run : after.runs) {
    for (auto& [field, regions] : run.errors) regions["all"].error.l2 *= 2.0;
  }
  after.series = build_series(after.runs);
  std::string const text = changes_from(typical(), after, TableFormat::table);
  BOOST_TEST(text.find(" more: --section changes --format csv") == std::string::npos, text);
  Json const json = Json::parse(changes_from(typical(), after, TableFormat::json));
  auto const& changes = json.at("changes")[0].at("changes");
  BOOST_TEST(changes.size() == 20u);  // four of 24 fail in both
  BOOST_TEST(json.at("documents")[1].at("name") == "after");
  auto const lines = lines_of(changes_from(typical(), after, TableFormat::csv));
  BOOST_TEST(lines.size() == 21u);
  for (LayoutChoice const& layout : {LayoutChoice{"hexagonal"}, LayoutChoice{"close-packed"}})
    add_ladder(after.runs, "conduction/brookshaw", true, layout, 0.0, 2e-3, 2.0);
  Results before = typical();
  for (LayoutChoice const& layout : {LayoutChoice{"hexagonal"}, LayoutChoice{"close-packed"}})
    add_ladder(before.runs, "conduction/brookshaw", true, layout, 0.0, 1e-3, 2.0);
  before.series = build_series(before.runs);
  after.series = build_series(after.runs);
  std::string const longer = changes_from(before, after, TableFormat::table);
  BOOST_TEST(longer.find("and 2 more: --section changes --format csv") != std::string::npos, longer);
}

BOOST_AUTO_TEST_CASE(documents_of_other_resolutions_do_not_share_a_table) {
  Results coarse = typical();
  std::erase_if(coarse.runs, [](RunRecord const& run) { return run.resolution == 200; });
  coarse.series = build_series(coarse.runs);
  std::string const text = compare({{"fine", typical()}, {"coarse", coarse}}, {});
  BOOST_TEST(text.find("N = 200: order or verdict") != std::string::npos);
  BOOST_TEST(text.find("N = 100: order or verdict") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(csv_of_envelopes_alone_is_of_envelopes) {
  Results results;
  Envelope envelope;
  envelope.case_id = "conduction/slab-dirichlet";
  envelope.formulation.id = "conduction/brookshaw";
  envelope.parameter = "amplitude";
  envelope.held = 0.25;
  results.envelopes = {envelope};
  BOOST_TEST(table_of(results, TableFormat::csv).find("amplitude") != std::string::npos);
  BOOST_TEST(table_of(results, TableFormat::table).find("How far amplitude could be driven") !=
             std::string::npos);
  BOOST_TEST(table_of(results, TableFormat::markdown).find("| 0.25 |") != std::string::npos);
  BOOST_TEST(Json::parse(table_of(results, TableFormat::json)).at("envelopes").size() == 1u);
}

BOOST_AUTO_TEST_CASE(a_study_that_ran_nothing_says_so) {
  for (TableFormat const format : {TableFormat::table, TableFormat::markdown})
    BOOST_TEST(table_of(Results{}, format).find("No series") != std::string::npos);
}

// A program that reads JSON must get JSON, also of nothing.
BOOST_AUTO_TEST_CASE(a_study_that_ran_nothing_is_still_json) {
  BOOST_TEST(Json::accept(table_of(Results{}, TableFormat::json)));
}

BOOST_AUTO_TEST_SUITE_END()
