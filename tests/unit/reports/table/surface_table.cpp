// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/surface_table.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <set>
#include <sstream>

BOOST_AUTO_TEST_SUITE(reports_table_surface_table)

using namespace sphverify;

Surface surface_of(std::string const& formulation, std::string const& field) {
  Surface s;
  s.case_id = "conduction/slab-dirichlet";
  s.label = formulation;
  s.formulation.id = formulation;
  ErrorSurface& e = s.error;
  e.field = field;
  e.region = "all";
  e.norm = "l2";
  e.model = "smoothing and sampling, added";
  e.reason = "closest of 16 laws; it misses the errors by 5%";
  e.law.emplace();
  e.misfit = 0.05;
  e.smoothing_exponent = {2.0, 1.9, 2.1};
  e.sampling_exponent = {3.0, 2.8, 3.3};
  e.spacing_exponent = {-0.5, -0.6, -0.4};
  e.neighbour_exponent = {0.5, 0.45, 0.55};
  e.best = {{25, {1.5, 1.4, 1.65}, "", 0.01, 1.25, 0.012},
            {50, {4.0, 4.0, 4.0}, "upper", 0.002, 4.0, 0.0021}};
  for (int const n : {25, 50}) {
    for (double const ratio : {1.25, 2.0, 4.0}) {
      SurfaceCell cell;
      cell.resolution = n;
      cell.smoothing_ratio = ratio;
      cell.error = cell.fitted =
          (n == 25 ? 0.012 : 0.0021) * (1.0 + std::abs(ratio - (n == 25 ? 1.25 : 4.0)));
      e.cells.push_back(cell);
    }
  }
  SurfacePath path;
  path.cost.unit = "pair_interactions";
  path.points = {{0.01, 25.0, {1.5, {}, {}}, 900.0, ""}, {0.002, 50.0, {4.0, {}, {}}, 9000.0, "upper"}};
  path.grid_exponent = 0.37;
  path.rules = {{0.0, 50.0, 1.5, 0.008, {4.2, 3.9, 4.4}, {7.1, 6.0, 8.0}, ""},
                {0.5, 48.0, 2.1, 0.003, {1.3, 1.1, 1.6}, {}, "no such error on the best path"}};
  e.paths = {path};
  return s;
}

std::vector<SurfaceRow> rows_of(std::vector<Surface> surfaces) {
  NamedResults document{"a.json", {}};
  document.results.surfaces = std::move(surfaces);
  return surface_rows({document});
}

/// A text with its line breaks taken for spaces, so that a sentence is found wherever its lines end.
std::string in_one_line(std::string const& text) {
  std::istringstream words(text);
  std::string all, word;
  while (words >> word) all += (all.empty() ? "" : " ") + word;
  return all;
}

bool contains(std::string const& text, std::string const& part) {
  return text.find(part) != std::string::npos;
}

BOOST_AUTO_TEST_CASE(the_answer_of_a_formulation_stands_first_in_one_sentence) {
  CompareOptions const options;
  std::string const text =
      in_one_line(surfaces_text(rows_of({surface_of("conduction/brookshaw", "temperature")}), options));
  std::size_t const answer = text.find(
      "brookshaw, lattice: h/dx 1.5 (1.4-1.65) at N = 25, >= 4 at N = 50; neighbours ~ N^0.5 "
      "(0.45-0.55); at the same cost N^0.5 errs 1.3 times as much as the best path, h/dx kept at 1.5 "
      "4.2 times.");
  BOOST_TEST_REQUIRE(answer != std::string::npos, text);
  BOOST_TEST(answer < text.find("h/dx of least error by the law"));
  Surface without = surface_of("conduction/brookshaw", "temperature");
  without.error.neighbour_exponent = {};
  BOOST_TEST(!contains(in_one_line(surfaces_text(rows_of({without}), options)), "; neighbours ~ N^"));
  BOOST_TEST(text.starts_with("conduction/slab-dirichlet "), text);
  for (char const* cell :
       {"1.25: 1.2e-2", "-0.5 (-0.6 to -0.4)", "0.37", "5.1%", "1.0e-2: 25, 1.5", "7.1 (6-8)"})
    BOOST_TEST(contains(text, cell), cell);
}

BOOST_AUTO_TEST_CASE(what_erred_least_is_taken_where_the_law_is_no_better_known_than_its_gain) {
  auto const answer = [](double fitted_at_least, Estimate const& by_law) {
    Surface surface = surface_of("conduction/brookshaw", "temperature");
    ErrorSurface& e = surface.error;
    e.best[1].ratio = by_law;
    e.best[1].edge = "";
    e.best[1].grid_ratio = 1.25;
    for (SurfaceCell& cell : e.cells) {
      if (cell.resolution == 50 && cell.smoothing_ratio == 1.25) cell.fitted = fitted_at_least;
    }
    return in_one_line(surfaces_text(rows_of({surface}), CompareOptions{}));
  };
  // The law's best is 0.002, its misfit 5%.
  for (Estimate const& by_law : {Estimate{4.0, 4.0, 4.0}, Estimate{3.0, 1.0, 5.0}}) {
    std::string const taken = answer(0.00209, by_law);
    BOOST_TEST(contains(taken, "1.25 at N = 50 (measured; by the law"), taken);
    BOOST_TEST(contains(taken, "within its misfit of 5.1%)"), taken);
  }
  std::string const apart = answer(0.0022, {4.0, 4.0, 4.0});
  BOOST_TEST(contains(apart, "4 at N = 50 by the law, though 1.25 erred least of those that ran"), apart);
  std::string const next = answer(0.00209, {1.5, 1.4, 1.6});
  BOOST_TEST(contains(next, "1.5 (1.4-1.6) at N = 50;"), next);
}

BOOST_AUTO_TEST_CASE(where_runs_failed_nothing_is_advised) {
  Surface surface = surface_of("conduction/brookshaw", "temperature");
  for (SurfaceCell& cell : surface.error.cells) {
    if (cell.smoothing_ratio == 4.0) cell.error.reset();
  }
  surface.error.best[1].grid_ratio = 2.0;
  std::string const text = in_one_line(surfaces_text(rows_of({surface}), CompareOptions{}));
  BOOST_TEST(contains(text, "2 at N = 50 (measured; by the law >= 4, where no error counts)"), text);
  BOOST_TEST(contains(text, ". No error counts at h/dx 4 (a run failed, or rounding)."), text);
}

BOOST_AUTO_TEST_CASE(without_a_law_the_grid_answers_and_the_reason_is_said) {
  Surface surface = surface_of("conduction/brookshaw", "temperature");
  surface.error.law.reset();
  surface.error.reason = "no law: because";
  surface.error.paths.clear();
  for (BestRatio& best : surface.error.best) best.ratio = {};
  std::string const text = in_one_line(surfaces_text(rows_of({surface}), CompareOptions{}));
  BOOST_TEST(contains(text, "of the grid h/dx 1.25 at N = 25 and 4 at N = 50; no law: because"), text);
  BOOST_TEST(!contains(text, "The path of least"));
}

BOOST_AUTO_TEST_CASE(text_shows_the_field_that_a_case_is_about_and_csv_all) {
  auto const rows = rows_of(
      {surface_of("conduction/lucy-flux", "flux"), surface_of("conduction/lucy-flux", "temperature")});
  std::string const text = surfaces_text(rows, CompareOptions{});
  BOOST_TEST(contains(text, "l2 error of temperature"));
  BOOST_TEST(!contains(text, "of flux"));
  std::istringstream csv(surfaces_csv(rows));
  std::vector<std::string> lines;
  for (std::string line; std::getline(csv, line);) lines.push_back(line);
  BOOST_TEST_REQUIRE(lines.size() == 5u);
  BOOST_TEST(contains(lines[0], ",field,norm,resolution,smoothing_ratio,smoothing_ratio_low,"));
  BOOST_TEST(contains(lines[0], ",pair_interactions_kept_cost_ratio,pair_interactions_kept_cost_ratio_low,"), lines[0]);
  auto const cells = [](std::string const& line) { return std::count(line.begin(), line.end(), ','); };
  for (std::string const& line : lines) BOOST_TEST(cells(line) >= cells(lines[0]), line);
  BOOST_TEST(contains(lines[1], ",flux,l2,25,1.5,1.4,1.65,,0.01,1.25,0.012,2,1.9,2.1,"));
  std::set<std::string> names;
  std::istringstream header(lines[0]);
  std::size_t count = 0;
  for (std::string name; std::getline(header, name, ','); ++count) names.insert(name);
  BOOST_TEST(names.size() == count, "no name twice");
  BOOST_TEST(surfaces_json(rows).size() == 2u);
}

BOOST_AUTO_TEST_CASE(formulations_of_one_case_share_its_tables) {
  CompareOptions options;
  options.style.format = TableFormat::markdown;
  auto const rows = rows_of(
      {surface_of("conduction/brookshaw", "temperature"), surface_of("conduction/lucy-flux", "temperature")});
  std::string const text = surfaces_text(rows, options);
  BOOST_TEST(contains(text, "- brookshaw, lattice: "));
  BOOST_TEST(contains(text, "| lucy-flux | lattice | 1.5 (1.4-1.65) | >= 4 |"));
  std::string const heading = "Which h/dx at which N";
  BOOST_TEST(text.find(heading) == text.rfind(heading));
}

BOOST_AUTO_TEST_SUITE_END()
