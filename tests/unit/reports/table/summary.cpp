// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/summary.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "reports/table/number_text.hpp"
#include "reports/table/summary_text.hpp"

BOOST_AUTO_TEST_SUITE(reports_table_summary)

using namespace sphverify;
using boost::test_tools::tolerance;

/// A ladder at N = 100 whose error is relative to a field of size 2.
SeriesRow ladder(std::string const& form, std::string const& case_id, std::string const& layout, double error,
                 std::string const& density = "given") {
  SeriesRow row{};
  row.document = "r";
  row.case_id = case_id;
  row.choice.id = row.formulation = form;
  row.discretisation.layout.id = layout;
  row.discretisation.density = density;
  row.field = "temperature";
  row.norm = "l2";
  row.verdict = "asymptotic";
  row.finest = 100;
  row.first_resolution = 25;
  row.error = 2.0 * error;
  row.relative_error = error;
  return row;
}

SeriesRow failing(SeriesRow row) {
  row.failures = "unstable 1/1";
  row.error.reset();
  row.relative_error.reset();
  row.verdict = row.field = "";
  return row;
}

SeriesRow diverging(SeriesRow row) {
  row.verdict = "diverging";
  return row;
}

constexpr char const* one = "conduction/one";
constexpr char const* two = "conduction/two";

BOOST_AUTO_TEST_CASE(one_setting_for_all_scenes_and_not_the_best_of_each) {
  // "given" is best on the lattice, "summation" on disorder; over both "summation" is: 2e-3 * 1e-3 < 1e-4 *
  // 9e-2.
  auto const groups = summary_of(
      {ladder(one, "c/a", "lattice", 1e-4, "given"), ladder(one, "c/a", "glass", 9e-2, "given"),
       ladder(one, "c/a", "lattice", 2e-3, "summation"), ladder(one, "c/a", "glass", 1e-3, "summation")},
      {});
  BOOST_REQUIRE(groups.size() == 1u);
  SummaryRow const& row = groups[0].rows.at(0);
  BOOST_TEST(row.setting.discretisation.density == "summation");
  BOOST_TEST(*row.error == std::sqrt(2e-6), tolerance(1e-12));
  BOOST_TEST(*row.worst_error == 2e-3, tolerance(1e-12));
  BOOST_TEST(scene_name(groups[0], row.worst_scene) == "a, lattice");
  BOOST_TEST(row.settings_tried == 2u);
  BOOST_TEST(setting_text(row) == "density summation, h/dx 1.2");
}

BOOST_AUTO_TEST_CASE(a_failure_and_then_a_divergence_count_more_than_any_error) {
  auto const setting_of = [](SeriesRow const& given, SeriesRow const& summation) {
    return summary_of({given, summation}, {}).at(0).rows.at(0).setting.discretisation.density;
  };
  SeriesRow const good = ladder(one, "c/a", "lattice", 1e-6);
  SeriesRow const bad = ladder(one, "c/a", "lattice", 0.9, "summation");
  BOOST_TEST(setting_of(good, bad) == "given");
  BOOST_TEST(setting_of(diverging(good), bad) == "summation");
  BOOST_TEST(setting_of(failing(good), bad) == "summation");
  BOOST_TEST(setting_of(failing(good), diverging(bad)) == "summation");

  auto const group =
      summary_of({ladder(one, "c/a", "lattice", 0.9), diverging(ladder(two, "c/a", "lattice", 1e-6)),
                  failing(ladder("conduction/three", "c/a", "lattice", 1.0))},
                 {})
          .at(0);
  BOOST_TEST(group.rows[0].name == "one");
  BOOST_TEST(group.rows[1].name == "two");
  BOOST_TEST(group.rows[2].name == "three");
  BOOST_TEST(group.rows[2].failed == 1);
  auto const words = sentences(group);
  BOOST_TEST(words[0] == "one: smallest error: 9.0e-1");
  BOOST_TEST(words[1].starts_with("two: diverges"), words[1]);
  BOOST_TEST(words[2] == "three: fails (unstable)");
}

BOOST_AUTO_TEST_CASE(who_fails_less_stands_first_without_being_said_to_be_nearest) {
  std::vector<SeriesRow> rows;
  for (char const* case_id : {"c/a", "c/b", "c/d"}) {
    rows.push_back(ladder(one, case_id, "lattice", 0.5));
    rows.push_back(ladder(two, case_id, "lattice", 1e-3));
  }
  rows.back() = failing(rows.back());
  auto const words = sentences(summary_of(rows, {}).at(0));
  BOOST_TEST(words[0].starts_with("one: fails and diverges least: error 5.0e-1"), words[0]);
  BOOST_TEST(words[1].starts_with("two: fails on 1 of 3 (unstable), error x0.0"), words[1]);
  BOOST_TEST(words[1].find("nearer on 2") != std::string::npos, words[1]);
}

BOOST_AUTO_TEST_CASE(what_a_case_chooses_is_no_setting) {
  // Each case has a viscosity of its own; density is varied on the first case alone.
  std::vector<SeriesRow> rows{ladder(one, "c/a", "lattice", 1e-2, "given"),
                              ladder(one, "c/a", "lattice", 1e-3, "summation"),
                              ladder(one, "c/b", "lattice", 1e-2, "given")};
  rows[2].discretisation.viscosity = {1.0, 2.0};
  auto const group = summary_of(rows, {}).at(0);
  BOOST_TEST(group.scenes.size() == 2u);
  BOOST_TEST(group.rows.at(0).missing == 0);
  BOOST_TEST(group.rows[0].settings_tried == 2u);
  BOOST_TEST(group.rows[0].choices == std::vector<std::string>{"density"});
  BOOST_TEST(*group.rows[0].error == std::sqrt(1e-5), tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_setting_that_some_scene_lacks_is_worse_than_one_that_ran_everywhere) {
  std::vector<SeriesRow> const rows{ladder(one, "c/a", "lattice", 1e-6, "given"),
                                    ladder(one, "c/a", "lattice", 1e-2, "summation"),
                                    ladder(one, "c/a", "glass", 1e-2, "summation")};
  auto const row = summary_of(rows, {}).at(0).rows.at(0);
  BOOST_TEST(row.setting.discretisation.density == "summation");
  BOOST_TEST(row.settings_tried == 1u);
}

BOOST_AUTO_TEST_CASE(controls_never_stand_first) {
  std::vector<SeriesRow> rows{ladder("momentum/control", "c/a", "lattice", 1e-9),
                              ladder(one, "c/a", "lattice", 1e-8), ladder(two, "c/a", "lattice", 1e-2)};
  rows[1].choice.walls = false;
  auto const group = summary_of(rows, {"momentum/control"}).at(0);
  BOOST_TEST(group.rows[0].name == "two");
  BOOST_TEST(!group.rows[0].is_control);
  BOOST_TEST(group.rows[1].is_control);
  BOOST_TEST(group.rows[2].name == "one (walls off)");
  BOOST_TEST(group.rows[2].is_control);
  BOOST_TEST(group.rows[0].nearest == 1, "controls take no scene from it");
  BOOST_TEST(sentences(group).size() == 1u);
  rows.pop_back();
  BOOST_TEST(sentences(summary_of(rows, {"momentum/control"}).at(0))[0].starts_with("Only controls"));
}

BOOST_AUTO_TEST_CASE(errors_within_their_intervals_are_not_told_apart) {
  auto const sentence = [](Number half_width, Number share) {
    SeriesRow near = ladder(one, "c/a", "jittered", 1.0e-3);
    SeriesRow far = ladder(two, "c/a", "jittered", 1.2e-3);
    near.seed_half_width = far.seed_half_width = half_width;
    near.time_error_share = share;
    auto const words = sentences(summary_of({near, far}, {}).at(0));
    bool const is_told = words.at(1).find("cannot be told") == std::string::npos;
    BOOST_TEST(words.at(0) ==
               (is_told ? "one: smallest error: 1.0e-3" : "one and two cannot be told apart: error 1.0e-3"));
    return words.at(1);
  };
  // The errors themselves are 2e-3 and 2.4e-3.
  BOOST_TEST(sentence(1e-4, {}) == "two: error x1.20");
  BOOST_TEST(sentence(2.1e-4, {}).starts_with("two: cannot be told from one"), sentence(2.1e-4, {}));
  BOOST_TEST(sentence(1e-4, 0.11).starts_with("two: cannot be told from one"));
}

BOOST_AUTO_TEST_CASE(errors_in_time_that_are_not_known_tell_nothing_apart) {
  SeriesRow const near = ladder(one, "c/a", "lattice", 1e-3);
  SeriesRow far = ladder(two, "c/a", "lattice", 2e-3);
  far.time_error_is_unknown = true;
  auto const words = sentences(summary_of({near, far}, {}).at(0));
  BOOST_TEST(words.at(0) == "one and two cannot be told apart: error 1.0e-3");
  BOOST_TEST(words.at(1) == "two: cannot be told from one (errors in time are not known)");
}

BOOST_AUTO_TEST_CASE(uneven_intervals_of_orders_are_shown_by_their_ends) {
  BOOST_TEST(order_with_interval(1.5, 1.38, 1.6) == "1.5±0.1");
  BOOST_TEST(order_with_interval(0.41, 0.2, 1.85) == "0.4 (0.2-1.9)");
  BOOST_TEST(order_with_interval(0.5, -0.4, 0.6) == "0.5 (-0.4 to 0.6)");
  BOOST_TEST(order_with_interval(2.0, 1.9, 2.14) == "2.0±0.1");
  BOOST_TEST(order_with_interval(2.0, -10.0, 14.0) == "2.0±12");
}

BOOST_AUTO_TEST_CASE(a_floor_and_an_order_that_is_missing_are_said_to_be_of_which_scene) {
  std::vector<SeriesRow> rows{ladder(one, "c/a", "lattice", 1e-4), ladder(one, "c/b", "lattice", 1e-2),
                              ladder(one, "c/a", "lattice", 1e-3), ladder(one, "c/b", "lattice", 2e-1)};
  rows[2].choice.walls = rows[3].choice.walls = false;
  for (SeriesRow& row : rows) row.order = 1.0, row.lower = 0.9, row.upper = 1.1;
  rows[1].order.reset();
  rows[1].verdict = "floored";
  rows[1].reason = "most of what is left is a floor; the signed error changes its sign 2 times";
  // Of a control nobody asks what it comes down to.
  for (std::size_t const k : {1u, 2u}) rows[k].floor = 0.5, rows[k].floor_low = 0.4, rows[k].floor_high = 0.6;
  CompareOptions options;
  options.section = "summary";
  std::string const text = summary_text(summary_of(rows, {}), {{}, options, {}});
  BOOST_TEST(text.find("\nNo order of one: b: most of what is left is a floor.\n") != std::string::npos,
             text);
  BOOST_TEST(text.find("\nFloors: one on b.\n") != std::string::npos, text);
}

BOOST_AUTO_TEST_CASE(that_no_mode_grows_has_to_be_known_of_every_scene_that_was_looked_at) {
  std::vector<SeriesRow> rows{ladder(one, "c/a", "lattice", 1e-3), ladder(one, "c/b", "lattice", 1e-3),
                              ladder(one, "c/d", "lattice", 1e-3)};
  rows[0].stability.emplace().growing_modes = 0;
  auto const row = [&] { return summary_of(rows, {}).at(0).rows.at(0); };
  BOOST_TEST(*row().growing_modes == 0.0);
  rows[1].stability.emplace();
  BOOST_TEST(row().is_linearised);
  BOOST_TEST(!row().growing_modes.has_value());
  rows[0].stability->growing_modes = 2;
  BOOST_TEST(*row().growing_modes == 2.0);
}

BOOST_AUTO_TEST_CASE(who_wins_here_and_loses_there_is_said_to) {
  auto const group = summary_of({ladder(one, "c/a", "lattice", 1e-4), ladder(one, "c/b", "lattice", 1e-2),
                                 ladder(two, "c/a", "lattice", 1e-3), ladder(two, "c/b", "lattice", 2e-3)},
                                {})
                         .at(0);
  BOOST_TEST(group.rows[0].name == "one");
  BOOST_TEST(group.rows[0].nearest == 1);
  BOOST_TEST(group.rows[1].nearest == 1);
  BOOST_TEST(group.rows[1].against_first.nearer == 1);
  BOOST_TEST(*group.rows[1].against_first.ratio == std::sqrt(2.0), tolerance(1e-12));
  BOOST_TEST(sentences(group)[0] == "one: smallest error on 1 of 2 scenes: 1.0e-3 (mean), 1.0e-2 (worst)");
  BOOST_TEST(sentences(group)[1] == "two: error x1.41 (0.20 to 10), nearer on 1");
}

BOOST_AUTO_TEST_CASE(only_who_ran_the_same_scenes_is_ranked_together) {
  std::vector<SeriesRow> rows{ladder(one, "c/a", "lattice", 1e-3), ladder(two, "c/a", "lattice", 1e-2),
                              ladder(one, "c/b", "lattice", 1e-3), ladder(two, "c/b", "lattice", 1e-2),
                              ladder(one, "c/alone", "lattice", 1e-1)};
  SeriesRow momentum = ladder("momentum/m", "c/a", "lattice", 1e-3);
  momentum.field = "acceleration";
  rows.push_back(momentum);
  auto const groups = summary_of(rows, {});
  BOOST_REQUIRE(groups.size() == 3u);
  BOOST_TEST(groups[0].scenes.size() == 2u);
  BOOST_TEST(groups[0].rows.size() == 2u);
  BOOST_TEST(*groups[0].rows[0].error == 1e-3, tolerance(1e-12));
  BOOST_TEST(groups[1].rows.size() == 1u);
  BOOST_TEST(groups[2].rows.size() == 1u);
}

BOOST_AUTO_TEST_CASE(a_row_shows_the_worst_of_its_scenes) {
  SeriesRow a = ladder(one, "c/a", "lattice", 1e-3);
  SeriesRow b = ladder(one, "c/b", "lattice", 1e-3);
  a.order = 2.0, a.lower = 1.9, a.upper = 2.1, a.floor = 1e-6, a.floor_low = -1e-7, a.floor_high = 2e-6;
  b.order = 0.5, b.lower = 0.2, b.upper = 0.9, b.floor = 1e-5, b.floor_low = 1e-6, b.floor_high = 2e-5;
  a.wall_flux_error = 0.9;  // no heat crosses there
  b.wall_flux_error = 0.1;
  b.heat_crosses_walls = true;
  a.energy_pair_drift = -1e-15, a.energy_rounding = 1e-14;
  b.energy_pair_drift = -1e-3, b.energy_rounding = 1e-14;
  a.stability = b.stability = Stability{};
  b.stability->growing_modes = 3;
  a.seconds = b.seconds = 1.0;
  a.to_percent.seconds = 0.1;
  auto const row = [&] { return summary_of({a, b}, {}).at(0).rows.at(0); };
  BOOST_TEST(*row().order == 0.5);
  BOOST_TEST(*row().order_high == 0.9);
  BOOST_TEST(*row().floor == 1e-5);
  BOOST_TEST(*row().wall_flux == 0.1);
  BOOST_TEST(*row().energy_pair_drift == 1e-3);
  BOOST_TEST(*row().growing_modes == 3.0);
  BOOST_TEST(!row().seconds_to_percent.has_value(), "one scene never gets there");
  BOOST_TEST(row().reach_percent == 1);
  b.percent_target.resolution = 400.0;
  BOOST_TEST(*row().percent_resolution == 400.0);
  b.order.reset();
  BOOST_TEST(!row().order.has_value(), "one scene has none");
  b.to_percent.seconds = 0.3;
  BOOST_TEST(*row().seconds_to_percent == 0.3);
  BOOST_TEST(!row().percent_resolution.has_value());
}

BOOST_AUTO_TEST_CASE(errors_below_rounding_are_no_merit) {
  SeriesRow exact = ladder(one, "c/a", "lattice", 0.0);
  exact.relative_error = 0.0;
  SeriesRow rounded = ladder(two, "c/a", "lattice", 1e-17);
  exact.round_off = rounded.round_off = 1e-15;
  auto const group = summary_of({exact, rounded}, {}).at(0);
  BOOST_TEST(std::isfinite(*group.rows[0].error));
  BOOST_TEST(group.rows[1].against_first.alike == 1);
}

BOOST_AUTO_TEST_SUITE_END()
