// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/ladder_table.hpp"

#include <boost/test/unit_test.hpp>
#include <sstream>

#include "reports/user_error.hpp"

BOOST_AUTO_TEST_SUITE(harness_measure_ladder_table)

using namespace sphverify;
using boost::test_tools::tolerance;

std::vector<LadderColumn> read(std::string const& text) {
  std::istringstream stream(text);
  return read_ladder_table(stream, "t.csv");
}

BOOST_AUTO_TEST_CASE(rows_become_levels_from_coarse_to_fine) {
  auto const columns = read("# from a paper\nl1, N ,linf\n0.25,40,0.5\n\n1,20,2\r\n0.0625,80,0.125\n");
  BOOST_TEST(columns.size() == 2u);
  BOOST_TEST(columns[0].name == "l1");
  BOOST_TEST(columns[1].name == "linf");
  BOOST_TEST(columns[0].levels.size() == 3u);
  BOOST_TEST(columns[0].levels[0].spacing == 1.0 / 20.0);
  BOOST_TEST(columns[0].levels[0].errors == std::vector<double>{1.0});
  BOOST_TEST(columns[1].levels[2].errors == std::vector<double>{0.125});
}

BOOST_AUTO_TEST_CASE(rows_of_one_spacing_with_seeds_are_replicates) {
  auto const columns = read("spacing,seed,e\n0.5,1,1\n0.5,2,3\n0.25,1,0.5\n0.25,2,\n");
  BOOST_TEST(columns[0].levels[0].errors == (std::vector<double>{1.0, 3.0}));
  // A level of which one run failed has no error.
  BOOST_TEST(columns[0].levels[1].errors.empty());
}

BOOST_AUTO_TEST_CASE(a_complaint_names_file_line_column_found_and_expected) {
  try {
    read("N,e\n10,0.1\n20,0,05\n");
    BOOST_ERROR("taken");
  } catch (UserError const& error) {
    BOOST_TEST(std::string(error.what()) == "t.csv:3:1: columns: found 3, expected 2, as in the line of names");
  }
}

BOOST_AUTO_TEST_SUITE_END()
