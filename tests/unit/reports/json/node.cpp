// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/json/node.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>

#include "reports/json/parse.hpp"
#include "tests/support/documents.hpp"

BOOST_AUTO_TEST_SUITE(reports_json_node)

using namespace sphverify;
using namespace sphverify::tests;

/// What is said of a file with this text.
std::string said_of_file(std::string const& text) {
  TemporaryFolder const folder;
  std::string const path = folder.file("f.json");
  write_text(path, text);
  std::string const said = complaint([&] { read_json_file(path); });
  BOOST_TEST((said.empty() || said.starts_with(path + ":")), said);
  BOOST_TEST(said.find('\n') == std::string::npos);
  return said;
}

bool contains(std::string const& text, std::string const& part) {
  return text.find(part) != std::string::npos;
}

BOOST_AUTO_TEST_CASE(broken_files_are_refused_with_what_is_wrong) {
  BOOST_TEST(said_of_file(R"({"a": 1})") == "");
  BOOST_TEST(contains(said_of_file(""), "found an empty file"));
  BOOST_TEST(contains(said_of_file(" \n\t"), "found an empty file"));
  BOOST_TEST(contains(said_of_file("{\"a\": 1,\n\"b\""), ":2:4: found the end of the file"));
  BOOST_TEST(contains(said_of_file("{\n\n\"a\": x}"), ":3:6: found 'x', expected a value"));
  BOOST_TEST(!said_of_file("{\"a\": 1e999}").empty());
  BOOST_TEST(!said_of_file("{\"a\": NaN}").empty());
  BOOST_TEST(!said_of_file("\xff\xfe").empty());
  BOOST_TEST(
      contains(complaint([] { read_json_file("/no/such/file"); }), "/no/such/file: found no readable file"));
  BOOST_TEST(!complaint([] { read_json_file("/"); }).empty());
}

BOOST_AUTO_TEST_CASE(a_complaint_names_file_key_found_and_expected) {
  Json const json = Json::parse(R"({"a": [{"b": true}]})");
  Node const node(json, "f.json");
  BOOST_TEST(complaint([&] { node.at("a").elements()[0].at("b").number(); }) ==
             "f.json: a[0].b: found true, expected a number");
  BOOST_TEST(complaint([&] { node.at("c"); }) == "f.json: c: found nothing, expected this key");
  BOOST_TEST(complaint([&] { node.number(); }) == "f.json: found an object, expected a number");
}

BOOST_AUTO_TEST_CASE(whole_numbers_are_checked_for_kind_and_range) {
  Json const json = Json::parse(R"([1, 1.0, 1.5, -1, "1", 1e300, 9007199254740993, null])");
  auto const at = [&](std::size_t i) { return Node(json[i], "f", "k"); };
  BOOST_TEST(at(0).integer(0, 10) == 1);
  BOOST_TEST(at(1).integer(0, 10) == 1);
  for (std::size_t const i : {2u, 3u, 4u, 5u, 7u}) BOOST_CHECK_THROW(at(i).integer(0, 10), UserError);
  BOOST_TEST(at(6).integer(0, std::int64_t{1} << 60) == 9007199254740993);
}

BOOST_AUTO_TEST_CASE(whole_numbers_of_64_bits_end_where_these_do) {
  constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min(), most = std::numeric_limits<std::int64_t>::max();
  Json const json = Json::parse("[9223372036854775807, -9223372036854775808, -9223372036854775808.0, 9223372036854775808, "
                                "9223372036854775808.0, 18446744073709551615, 9223372036854774784.0]");
  auto const at = [&](std::size_t i) { return Node(json[i], "f", "k"); };
  BOOST_TEST(at(0).integer(least, most) == most);
  BOOST_TEST(at(1).integer(least, most) == least);
  BOOST_TEST(at(2).integer(least, most) == least);
  for (std::size_t const i : {3u, 4u, 5u}) BOOST_CHECK_THROW(at(i).integer(least, most), UserError);
  BOOST_TEST(at(6).integer(least, most) == most - 1023);
}

BOOST_AUTO_TEST_CASE(texts_are_json_where_files_would_be) {
  BOOST_TEST((parse_json(R"({"a": [1]})") == Json{{"a", {1}}}));
  std::string const deep(100000, '[');
  for (std::string const& text : {std::string("word"), std::string(R"({"a": 1, "a": 2})"), std::string(), deep,
                                  deep + std::string(deep.size(), ']')})
    BOOST_TEST(!parse_json(text).has_value());
}

BOOST_AUTO_TEST_CASE(other_reads_take_what_they_say_and_nothing_else) {
  Json const json =
      Json::parse(R"({"n": 2.5, "z": 0, "s": "text", "b": true, "l": [1, 2], "o": {}, "x": null})");
  Node const node(json, "f");
  BOOST_TEST(node.at("n").number() == 2.5);
  BOOST_TEST(node.at("n").positive_number() == 2.5);
  BOOST_CHECK_THROW(node.at("z").positive_number(), UserError);
  BOOST_CHECK_THROW(node.at("s").positive_number(), UserError);
  BOOST_TEST(node.at("n").number_between(2.5, 2.5) == 2.5);
  BOOST_CHECK_THROW(node.at("n").number_between(3.0, 4.0), UserError);
  BOOST_TEST(node.at("s").string() == "text");
  BOOST_CHECK_THROW(node.at("n").string(), UserError);
  BOOST_TEST(node.at("b").boolean());
  BOOST_CHECK_THROW(node.at("z").boolean(), UserError);
  BOOST_TEST(node.at("l").numbers()[1] == 2.0);
  BOOST_CHECK_THROW(node.at("n").numbers(), UserError);
  BOOST_TEST(node.at("l").one_or_many().size() == 2u);
  BOOST_TEST(node.at("n").one_or_many().size() == 1u);
  BOOST_CHECK_THROW(node.at("l").members(), UserError);
  BOOST_CHECK_THROW(node.at("l").find("x"), UserError);
  BOOST_TEST(!node.find("none").has_value());
  BOOST_TEST(node.at("x").is_null());
  BOOST_CHECK_THROW(node.at("x").number(), UserError);
  BOOST_TEST(node.members().size() == 7u);
}

BOOST_AUTO_TEST_CASE(long_values_are_cut_in_complaints) {
  Json const json(std::string(500, 'x'));
  std::string const said = complaint([&] { Node(json, "f", "k").number(); });
  BOOST_TEST(said.size() < 120u);
}

BOOST_AUTO_TEST_CASE(parameters_are_of_the_kind_of_their_defaults) {
  auto const read = [](char const* text, ParameterValue const& like, bool integer = false) {
    Json const json = Json::parse(text);
    return read_parameter(Node(json, "f", "k"), {"k", "", "", like, integer});
  };
  using Table = std::vector<std::vector<double>>;
  BOOST_TEST((read("1.5", 0.0) == ParameterValue(1.5)));
  BOOST_TEST((read("2", 0.0, true) == ParameterValue(2.0)));
  BOOST_CHECK_THROW(read("1.5", 0.0, true), UserError);
  BOOST_TEST((read("-2147483648", 0.0, true) == ParameterValue(-2147483648.0)));
  BOOST_CHECK_THROW(read("2147483649", 0.0, true), UserError);
  BOOST_CHECK_THROW(read("-2147483649", 0.0, true), UserError);
  BOOST_CHECK_THROW(read("\"a\"", 0.0), UserError);
  BOOST_TEST((read("\"a\"", std::string("b")) == ParameterValue(std::string("a"))));
  BOOST_CHECK_THROW(read("1", std::string("b")), UserError);
  BOOST_TEST((read("[1, 2]", std::vector<double>{}) == ParameterValue(std::vector<double>{1.0, 2.0})));
  BOOST_TEST((read("[[1, 2], [3]]", Table{}) == ParameterValue(Table{{1.0, 2.0}, {3.0}})));
  BOOST_CHECK_THROW(read("[1]", Table{}), UserError);
}

BOOST_AUTO_TEST_CASE(the_nearest_candidate_is_the_one_of_fewest_edits) {
  std::vector<std::string> const candidates{"lattice", "jittered", "conduction/brookshaw", "cost"};
  BOOST_TEST(nearest("latice", candidates) == "lattice");
  BOOST_TEST(nearest("", {"on", "off"}) == "");  // what is no text is near nothing
  BOOST_TEST(nearest("lattice", candidates) == "lattice");
  BOOST_TEST(nearest("jitterd", candidates) == "jittered");
  BOOST_TEST(nearest("brookshaw", candidates) == "conduction/brookshaw");
  BOOST_TEST(nearest("brokshaw", candidates) == "conduction/brookshaw");
  BOOST_TEST(nearest("costs", candidates) == "cost");
  BOOST_TEST(nearest("something else", candidates) == "");
  BOOST_TEST(nearest("x", {}) == "");
  BOOST_TEST(one_of("costs", {"cost", "error"}) == "one of cost, error (did you mean 'cost'?)");
  BOOST_TEST(one_of("wholly other", {"cost", "error"}) == "one of cost, error");
}

BOOST_AUTO_TEST_SUITE_END()
