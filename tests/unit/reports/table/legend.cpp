// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <sstream>

#include "reports/table/number_text.hpp"

BOOST_AUTO_TEST_SUITE(reports_table_legend)

using namespace sphverify;

std::vector<LegendEntry> entries() {
  return {{"*", "best"}, {"~", "cannot be told from it"}, {"", "A sentence stands alone."}, {"q", "grows"}};
}

BOOST_AUTO_TEST_CASE(on_a_terminal_marks_share_lines_and_sentences_do_not) {
  BOOST_TEST(legend(entries(), {}) ==
             "*: best   ~: cannot be told from it\nA sentence stands alone.\nq: grows\n");
}

BOOST_AUTO_TEST_CASE(lines_end_before_the_terminal_does) {
  std::vector<LegendEntry> many(30, {"mark", "means something"});
  many.push_back({"", fmt::format("{:a<60} {:b<60}", "", "")});
  std::istringstream text(legend(many, {.columns = 100}));
  std::size_t marks = 0;
  for (std::string line; std::getline(text, line);) {
    BOOST_TEST(text_width(line) <= 100u, line);
    for (std::size_t at = 0; (at = line.find("mark:", at)) != std::string::npos; ++at) ++marks;
  }
  BOOST_TEST(marks == 30u);
  // Two of 49 columns and what is between them are 101.
  LegendEntry const half{"m", std::string(46, 'a')};
  std::string const two = legend({half, half}, {.columns = 100});
  BOOST_TEST(std::count(two.begin(), two.end(), '\n') == 2);
}

BOOST_AUTO_TEST_CASE(in_markdown_it_is_a_list_whose_marks_are_not_markup) {
  BOOST_TEST(legend(entries(), {TableFormat::markdown}) ==
             "- `*`: best\n- `~`: cannot be told from it\n- A sentence stands alone.\n- `q`: grows\n");
}

BOOST_AUTO_TEST_SUITE_END()
