// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/budget_tables.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(reports_table_budget_tables)

using namespace sphverify;

/// The cells of the table: cold to hot, overshoot, undershoot, least entropy made.
std::vector<std::string> law_cells(Number const& entropy, std::string const& remark) {
  SeriesRow row{};
  row.case_id = "conduction/slab-dirichlet";
  row.formulation = row.choice.id = "conduction/brookshaw";
  row.second_law = SecondLaw{{0.3, 0.0, {}}, {0.2, 0.0, {}}, {0.1, 0.0, {}}, entropy, remark};
  std::vector<TextTable> const tables = budget_tables({row});
  BOOST_REQUIRE(tables.size() == 1u);
  BOOST_REQUIRE(tables[0].rows.size() == 1u);
  std::vector<std::string> const& cells = tables[0].rows[0];
  return {cells.end() - 4, cells.end()};
}

BOOST_AUTO_TEST_CASE(what_was_not_watched_of_the_second_law_is_not_shown_as_kept) {
  using Row = std::vector<std::string>;
  BOOST_TEST(law_cells(0.0, "")[3] != "-");
  BOOST_TEST(law_cells({}, "entropy: a wall has no temperature") == (Row{"10%", "30%", "20%", "-"}));
  BOOST_TEST(law_cells({}, "a wall brings heat: no bounds") == (Row{"10%", "-", "-", "-"}));
  BOOST_TEST(law_cells({}, "a source gives heat") == (Row{"-", "-", "-", "-"}));
}

BOOST_AUTO_TEST_SUITE_END()
