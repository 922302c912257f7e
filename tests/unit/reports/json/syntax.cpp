// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/json/syntax.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>
#include <random>

BOOST_AUTO_TEST_SUITE(reports_json_syntax)

using namespace sphverify;

std::string const document = R"({"a": [1, -2.5e-3, 0, 0.5E+2], "b": {"c": "t\"\\\u00e4\ud83d\ude00", "d": []},
  "e": [true, false, null, {}], "größe": ""})";

BOOST_AUTO_TEST_CASE(what_is_json_is_taken) {
  for (std::string const& text :
       {document, std::string("1"), std::string("\"a\""), std::string("\xEF\xBB\xBF[ ]\r\n")})
    BOOST_TEST(!find_syntax_error(text).has_value(), text);
}

BOOST_AUTO_TEST_CASE(it_agrees_with_the_parser_on_documents_that_are_broken_at_random) {
  std::mt19937_64 random(1);
  std::string const letters = "{}[]:,\"\\ \n0129.eE+-tfnul'/#a\x01\xC3\xA4\xFF";
  int broken = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text = document;
    for (int change = 0; change <= round % 3; ++change) {
      std::size_t const at = random() % text.size();
      char const letter = letters[random() % letters.size()];
      if (random() % 3 == 0) {
        text.erase(at, 1);
      } else if (random() % 2 == 0) {
        text.insert(at, 1, letter);
      } else {
        text[at] = letter;
      }
    }
    auto const error = find_syntax_error(text);
    bool const is_json = nlohmann::json::accept(text);
    broken += is_json ? 0 : 1;
    // A key twice is all that the parser takes and we do not.
    BOOST_REQUIRE_MESSAGE(is_json || error, text);
    BOOST_REQUIRE_MESSAGE(!is_json || !error || error->found.find("twice") != std::string::npos, text);
    if (error) BOOST_REQUIRE(error->line > 0 && error->column > 0 && !error->expected.empty());
  }
  BOOST_TEST(broken > 10000);
}

BOOST_AUTO_TEST_CASE(columns_are_characters_behind_what_marks_the_encoding) {
  auto const error = find_syntax_error("\xEF\xBB\xBF{\n\"größe\": x}");
  BOOST_TEST_REQUIRE(error.has_value());
  BOOST_TEST(error->line == 2u);
  BOOST_TEST(error->column == 10u);
}

BOOST_AUTO_TEST_SUITE_END()
