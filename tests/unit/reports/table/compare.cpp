#include "reports/table/compare.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <sstream>

#include "harness/measure/series.hpp"
#include "reports/json/node.hpp"

BOOST_AUTO_TEST_SUITE(reports_table_compare)

using namespace sphverify;

/// Three levels of a formulation on a layout and a path; the error goes down with the given order.
void add_ladder(std::vector<RunRecord>& runs, std::string const& formulation, bool walls,
                LayoutChoice const& layout, double exponent, double error, double order,
                std::string const& last_status = "ok") {
  for (int const n : {25, 50, 100}) {
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
    if (n == 100 && last_status != "ok") {
      run.status = last_status;
      run.reason = "because";
    } else {
      double const e = error * std::pow(25.0 / n, order);
      run.errors["temperature"]["all"] = {{e, e, e}, {2.0, 2.0, 2.0}, 1e-15};
    }
    runs.push_back(run);
  }
}

Results typical() {
  Results results;
  for (char const* id : {"conduction/brookshaw", "conduction/lucy-flux", "conduction/campbell-flux"}) {
    for (bool const walls : {true, false}) {
      for (LayoutChoice const& layout : {LayoutChoice{"lattice"}, LayoutChoice{"jittered", 0.1, 1}}) {
        for (double const exponent : {0.0, 0.5}) {
          bool const best = std::string(id) == "conduction/brookshaw" && walls;
          bool const fails = std::string(id) == "conduction/campbell-flux" && layout.id == "jittered";
          add_ladder(results.runs, id, walls, layout, exponent, best ? 1e-3 : 4e-2, best ? 2.0 : 0.02,
                     fails ? "unstable" : "ok");
        }
      }
    }
  }
  results.series = build_series(results.runs);
  return results;
}

std::string table_of(Results const& results, TableFormat format, bool colour = false) {
  CompareOptions options;
  options.format = format;
  options.colour = colour;
  return compare({{"r.json", results}}, options);
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

BOOST_AUTO_TEST_CASE(a_typical_table_fits_into_100_columns) {
  for (std::string const& line : lines_of(table_of(typical(), TableFormat::table)))
    BOOST_TEST(width_of(line) <= 100u, line);
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
  BOOST_TEST(std::abs(best.at("order").get<double>() - 2.0) < 1e-9);
  BOOST_TEST(std::abs(best.at("error").get<double>() - 1e-3 / 16.0) < 1e-12);
  BOOST_TEST(std::abs(best.at("relative_error").get<double>() - 0.5e-3 / 16.0) < 1e-12);
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
  for (char const* title : {"run time to 1% error", "run time to 0.1% error"}) {
    std::string const table = part(text, title);
    BOOST_TEST(row(table, "brookshaw ").find("1*") != std::string::npos, table);
    BOOST_TEST(row(table, "brookshaw (off)").find("3.0 (2.3-3.9)") != std::string::npos, table);
    BOOST_TEST(row(table, "lucy-flux ").find("9.0 (6.9-12)") != std::string::npos, table);
  }
  for (std::string const& line : lines_of(text)) BOOST_TEST(width_of(line) <= 100u, line);
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
  BOOST_TEST(first.at("median_seconds") == *results.runs[2].cost->median.median);
  BOOST_TEST(first.at("busy") == 0.5);
}

BOOST_AUTO_TEST_CASE(two_documents_are_told_apart) {
  CompareOptions const options;
  std::string const text = compare({{"old.json", typical()}, {"new.json", typical()}}, options);
  BOOST_TEST(text.find("old.json") != std::string::npos);
  BOOST_TEST(text.find("new.json") != std::string::npos);
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
