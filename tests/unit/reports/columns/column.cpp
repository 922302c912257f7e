// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/columns/column.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "tests/support/random_json.hpp"

BOOST_AUTO_TEST_SUITE(reports_columns_column)

using namespace sphverify;
using namespace sphverify::tests;
using Kind = Column::Kind;

namespace {

Column column_of(std::initializer_list<char const*> const& values) {
  Column column;
  for (char const* value : values) column.append(Json::parse(value));
  return column;
}

void require_same(std::vector<Json> const& values) {
  Column column;
  for (Json const& value : values) column.append(value);
  BOOST_REQUIRE(column.rows() == values.size());
  for (std::size_t k = 0; k < values.size(); ++k) BOOST_TEST((unordered(column.row(k)) == unordered(values[k])));
}

}  // namespace

BOOST_AUTO_TEST_CASE(values_that_are_alike_are_numbers_or_texts_beside_each_other) {
  BOOST_TEST((column_of({"1", "2"}).kind == Kind::whole));
  BOOST_TEST((column_of({"1.5", "2.0"}).kind == Kind::number));
  BOOST_TEST((column_of({"\"a\"", "null"}).kind == Kind::text));
  BOOST_TEST((column_of({"true", "false"}).kind == Kind::boolean));
  BOOST_TEST((column_of({"null", "null"}).kind == Kind::nothing));
  BOOST_TEST((column_of({"[]", "[1]"}).kind == Kind::list));
  BOOST_TEST((column_of({"{}", "null"}).kind == Kind::object));
}

BOOST_AUTO_TEST_CASE(integers_with_gaps_or_real_numbers_beside_them_are_real_numbers_if_that_changes_none) {
  for (auto const& values : {std::initializer_list<char const*>{"1", "null"}, {"null", "1"}, {"1", "2.5"}, {"2.5", "1"}}) {
    Column const column = column_of(values);
    BOOST_TEST((column.kind == Kind::number));
  }
  Column const gap = column_of({"1", "null"});
  BOOST_TEST(std::isnan(gap.numbers[1]));
  BOOST_TEST(gap.row(1).is_null());
  for (auto const& values : {std::initializer_list<char const*>{"9007199254740993", "null"}, {"null", "9007199254740993"},
                             {"9007199254740993", "2.5"}, {"2.5", "9007199254740993"}}) {
    Column const column = column_of(values);
    BOOST_TEST((column.kind == Kind::json));
    std::size_t k = 0;
    for (char const* value : values) BOOST_TEST(column.row(k++).dump() == value);
  }
}

BOOST_AUTO_TEST_CASE(values_that_are_not_alike_are_kept_as_json) {
  Column const column = column_of({"\"lattice\"", "null", R"({"id":"jittered","seed":1})", "1.0"});
  BOOST_TEST((column.kind == Kind::json));
  BOOST_TEST(column.row(0).dump() == "\"lattice\"");
  BOOST_TEST(column.row(1).is_null());
  BOOST_TEST(column.row(2).dump() == R"({"id":"jittered","seed":1})");
  BOOST_TEST(column.row(3).dump() == "1.0");
}

BOOST_AUTO_TEST_CASE(null_and_no_such_key_are_two_things) {
  Column const column = column_of({R"({"a":1.5})", R"({"a":null})", "{}", "null"});
  Column const& a = column.members.at("a");
  BOOST_TEST((a.gaps == std::vector<std::uint8_t>{Column::there, Column::null, Column::absent, Column::absent}));
  BOOST_TEST(column.row(1).dump() == R"({"a":null})");
  BOOST_TEST(column.row(2).dump() == "{}");
  BOOST_TEST(column.row(3).is_null());
}

BOOST_AUTO_TEST_CASE(what_is_not_finite_is_null_as_in_json) {
  Column column;
  column.append(std::numeric_limits<double>::quiet_NaN());
  column.append(-std::numeric_limits<double>::infinity());
  BOOST_TEST(column.row(0).is_null());
  BOOST_TEST(column.row(1).is_null());
}

BOOST_AUTO_TEST_CASE(lists_of_objects_are_columns_over_all_lists) {
  Column const column = column_of({R"([{"x":1.5},{"x":2.5}])", "[]", R"([{"x":3.5}])"});
  BOOST_TEST((column.starts == std::vector<std::uint64_t>{0, 2, 2, 3}));
  BOOST_TEST((column.elements.front().members.at("x").numbers == std::vector<double>{1.5, 2.5, 3.5}));
  BOOST_TEST(column.row(1).dump() == "[]");
}

BOOST_AUTO_TEST_CASE(text_that_is_not_utf8_is_what_json_makes_of_it) {
  Column column;
  column.append("\xff!");
  BOOST_TEST(column.row(0).get<std::string>() == "\uFFFD!");
}

BOOST_AUTO_TEST_CASE(documents_drawn_by_lot_come_back_as_they_were) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    RandomJson random(seed);
    std::vector<Json> documents;
    for (unsigned k = 0; k <= seed % 8; ++k) documents.push_back(random.object());
    BOOST_TEST_CONTEXT("seed " << seed) require_same(documents);
  }
}

BOOST_AUTO_TEST_SUITE_END()
