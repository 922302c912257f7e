// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/text_table.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <sstream>

BOOST_AUTO_TEST_SUITE(reports_table_text_table)

using namespace sphverify;

TextTable wide(std::size_t columns) {
  TextTable table{"title", {"label"}, {{"one"}, {"two"}}, 1, {}};
  for (std::size_t c = 0; c < columns; ++c) {
    table.header.push_back("column " + std::to_string(c));
    for (auto& row : table.rows) row.push_back(row[0] + " " + std::to_string(c));
  }
  return table;
}

BOOST_AUTO_TEST_CASE(a_table_wider_than_a_terminal_is_broken_into_blocks_that_repeat_the_labels) {
  std::istringstream text(render(wide(20), {TableFormat::table, false, 100}));
  std::size_t headers = 0;
  std::string all;
  for (std::string line; std::getline(text, line); all += line + "\n") {
    BOOST_TEST(line.size() <= 100u, line);
    headers += line.starts_with("label");
  }
  BOOST_TEST(headers > 1u);
  for (int c = 0; c < 20; ++c) {
    std::string const name = "column " + std::to_string(c);
    BOOST_TEST(all.find(name) != std::string::npos, name);
    BOOST_TEST(all.find("two " + std::to_string(c)) != std::string::npos);
  }
}

BOOST_AUTO_TEST_CASE(a_table_that_fits_is_one_block_to_the_last_column) {
  auto const headers = [](std::size_t width) {
    TextTable table{"title", {"label", std::string(width, 'x')}, {}, 1, {}};
    table.header.emplace_back("y");
    std::string const text = render(table, {TableFormat::table, false, 100});
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find("label", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  BOOST_TEST(headers(90) == 1u);  // 5 + 2 + 90 + 2 + 1 = 100
  BOOST_TEST(headers(91) == 2u);
}

BOOST_AUTO_TEST_CASE(names_are_broken_where_their_cells_are_narrower_but_a_number_stays_with_its_quantity) {
  TextTable const table{"", {"label", "jitter 0.1, h/dx 1.2 (N/25)^0.5"}, {{"one", "1.6e-4 ~1.6"}}, 1, {}};
  BOOST_TEST(render(table, {}) ==
             "       jitter 0.1,\n"
             "       h/dx 1.2\n"
             "label  (N/25)^0.5\n"
             "-----  -----------\n"
             "one    1.6e-4 ~1.6\n");
}

BOOST_AUTO_TEST_CASE(notes_stand_below_their_rows_or_in_a_column_of_their_own) {
  TextTable table{"title", {"label"}, {{"one"}, {"two"}}, 1, {}};
  table.note_name = "setting";
  table.notes = {"density given", ""};
  BOOST_TEST(render(table, {}) == "title\nlabel\n-----\none\n  density given\ntwo\n");
  BOOST_TEST(render(table, {TableFormat::csv}) == "label,setting\none,density given\ntwo,\n");
  BOOST_TEST(render(table, {TableFormat::markdown}) ==
             "### title\n\n| label | setting |\n|---|---|\n| one | density given |\n| two |  |\n");
}

BOOST_AUTO_TEST_CASE(titles_are_broken_with_their_indentation) {
  TextTable const table{"a case\n  of many words", {"n"}, {{"1"}}, 1, {}};
  BOOST_TEST(render(table, {.columns = 10}) == "a case\n  of many\n  words\nn\n-\n1\n");
}

BOOST_AUTO_TEST_CASE(other_formats_are_never_broken) {
  std::string const text = render(wide(20), {TableFormat::csv});
  BOOST_TEST(std::count(text.begin(), text.end(), '\n') == 3);
}

BOOST_AUTO_TEST_SUITE_END()
