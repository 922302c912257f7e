// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/time_ratio.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(reports_table_time_ratio)

using namespace sphverify;
using boost::test_tools::tolerance;

TimeToTarget time_of(double low, double median, double high) { return {low, {median, low, high}}; }

SeriesRow row(TimeToTarget const& time, std::string const& document = "r.json") {
  SeriesRow one{};
  one.document = document;
  one.to_percent = time;
  return one;
}

std::string text(std::vector<SeriesRow> const& rows, std::size_t k) {
  return TimeTable(rows, &SeriesRow::to_percent).entry(rows[k]).text;
}

bool is_fastest(std::vector<SeriesRow> const& rows, std::size_t k) {
  return TimeTable(rows, &SeriesRow::to_percent).entry(rows[k]).is_fastest;
}

BOOST_AUTO_TEST_CASE(the_ends_of_a_ratio_are_the_ends_of_the_times_divided_crosswise) {
  auto const ratio = time_ratio(time_of(4.0, 6.0, 9.0), time_of(1.0, 2.0, 3.0));
  BOOST_TEST(ratio->value == 3.0);
  BOOST_TEST(*ratio->low == 4.0 / 3.0, tolerance(1e-14));
  BOOST_TEST(*ratio->high == 9.0);
  TimeToTarget without{4.0, {6.0, {}, {}}};
  BOOST_TEST(time_ratio(without, time_of(1.0, 2.0, 3.0))->value == 3.0);
  BOOST_TEST(!time_ratio(without, time_of(1.0, 2.0, 3.0))->low.has_value());
  BOOST_TEST(time_ratio({4.0}, time_of(1.0, 2.0, 3.0))->value == 4.0, "no median: the times themselves");
  BOOST_TEST(!time_ratio({}, time_of(1.0, 2.0, 3.0)).has_value());
  BOOST_TEST(!time_ratio(time_of(1.0, 2.0, 3.0), {0.0}).has_value());
}

BOOST_AUTO_TEST_CASE(what_cannot_be_told_from_the_fastest_is_marked) {
  std::vector<SeriesRow> const rows{row(time_of(0.9, 1.0, 1.1)), row(time_of(1.0, 1.2, 1.3)),
                                    row(time_of(2.2, 2.4, 2.6)), row(time_of(90.0, 100.0, 121.0))};
  BOOST_TEST(text(rows, 0) == "1");
  BOOST_TEST(text(rows, 1) == "1.2 (0.9-1.4)~");
  BOOST_TEST(text(rows, 2) == "2.4 (2.0-2.9)");
  BOOST_TEST(text(rows, 3) == "100 (82-134)");
  BOOST_TEST(is_fastest(rows, 0));
  for (std::size_t k = 1; k < rows.size(); ++k) BOOST_TEST(!is_fastest(rows, k));
}

BOOST_AUTO_TEST_CASE(a_narrow_interval_is_written_by_its_further_end) {
  std::vector<SeriesRow> const rows{row(time_of(0.99, 1.0, 1.01)), row(time_of(1.98, 2.0, 2.02)),
                                    row(time_of(1.0, 1.005, 1.01)), row(time_of(29.8, 30.0, 30.1))};
  BOOST_TEST(text(rows, 1) == "2.00±0.05", "2.02 / 0.99 is 2.0404");
  BOOST_TEST(text(rows, 2) == "1.00±0.02~");
  BOOST_TEST(text(rows, 3) == "30.0±0.5");
}

BOOST_AUTO_TEST_CASE(the_fastest_is_so_by_its_median_and_not_by_a_lucky_repeat) {
  std::vector<SeriesRow> rows{row({1.0, {1.0, {}, {}}}), row({0.5, {2.0, {}, {}}})};
  BOOST_TEST(text(rows, 0) == "1");
  BOOST_TEST(text(rows, 1) == "2");
}

BOOST_AUTO_TEST_CASE(every_document_has_a_fastest_of_its_own) {
  std::vector<SeriesRow> const rows{row(time_of(0.9, 1.0, 1.1), "old"), row(time_of(9.0, 10.0, 11.0), "new"),
                                    row(time_of(36.0, 40.0, 44.0), "new")};
  BOOST_TEST(text(rows, 1) == "1");
  BOOST_TEST(is_fastest(rows, 1));
  BOOST_TEST(text(rows, 2) == "4.0 (3.3-4.9)");
}

BOOST_AUTO_TEST_CASE(a_bound_is_neither_fastest_nor_by_how_much) {
  TimeToTarget bound = time_of(0.9, 1.0, 1.1);
  bound.is_bound = true;
  std::vector<SeriesRow> rows{row(bound), row(time_of(2.2, 2.4, 2.6))};
  BOOST_TEST(text(rows, 0) == "<=1");
  BOOST_TEST(!is_fastest(rows, 0));
  BOOST_TEST(text(rows, 1) == ">=2.4");
  BOOST_TEST(!is_fastest(rows, 1));
  rows.push_back(row(time_of(0.4, 0.5, 0.6)));
  BOOST_TEST(text(rows, 0) == "<=2");
  BOOST_TEST(text(rows, 2) == "1");
}

BOOST_AUTO_TEST_CASE(who_failed_or_never_got_there_is_not_the_fastest) {
  std::vector<SeriesRow> rows{row({}), row(time_of(0.9, 1.0, 1.1))};
  BOOST_TEST(text(rows, 0) == "never");
  rows.push_back(row(time_of(0.1, 0.1, 0.1)));
  rows[2].failures = "unstable 1/1";
  BOOST_TEST(text(rows, 1) == "1");
  BOOST_TEST((TimeTable({rows[0]}, &SeriesRow::to_percent).is_empty()));
  BOOST_TEST((TimeTable(rows, &SeriesRow::to_permille).is_empty()));
}

BOOST_AUTO_TEST_CASE(what_diverges_is_the_fastest_only_where_nothing_else_got_there_and_never_marked) {
  for (bool const comes_first : {true, false}) {
    std::vector<SeriesRow> rows(2, row(time_of(0.9, 1.0, 1.1)));
    std::size_t const diverging = comes_first ? 0 : 1;
    rows[diverging] = row({0.5, {0.5, {}, {}}});
    rows[diverging].verdict = "diverging";
    BOOST_TEST(text(rows, 1 - diverging) == "1");
    BOOST_TEST(is_fastest(rows, 1 - diverging));
    BOOST_TEST(text(rows, diverging) == "0.5");
    BOOST_TEST(!is_fastest(rows, diverging));
    std::vector<SeriesRow> const alone{rows[diverging]};
    BOOST_TEST(text(alone, 0) == "1");
    BOOST_TEST(!is_fastest(alone, 0));
  }
}

BOOST_AUTO_TEST_CASE(a_machine_that_had_other_work_is_told_of) {
  std::vector<SeriesRow> rows(3);
  BOOST_TEST(disturbance(rows) == "");
  rows[0].busy = 0.99;
  BOOST_TEST(disturbance(rows) == "");
  rows[1].busy = 0.5;
  BOOST_TEST(disturbance(rows).starts_with("Disturbed timings: 1 of 3 ladders"), disturbance(rows));
  BOOST_TEST(disturbance(rows).find("at worst 50%") != std::string::npos, disturbance(rows));
}

BOOST_AUTO_TEST_SUITE_END()
