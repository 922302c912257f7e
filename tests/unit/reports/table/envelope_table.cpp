// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/envelope_table.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(reports_table_envelope_table)

using namespace sphverify;

/// A parameter that was driven from 1.2 down to 0.5.
Envelope driven(std::string const& formulation, Number held, Number failed, std::uint64_t seed = 0) {
  Envelope envelope;
  envelope.case_id = "conduction/slab-dirichlet";
  envelope.formulation.id = envelope.label = formulation;
  envelope.parameter = "smoothing_ratio";
  if (seed > 0) envelope.discretisation.layout = {"jittered", 0.1, seed};
  envelope.resolution = 50;
  envelope.held = held;
  envelope.failed = failed;
  envelope.status = failed ? "unstable" : "ok";
  envelope.points = {{0.5, failed ? "unstable" : "ok"}};
  return envelope;
}

std::vector<TextTable> tables_of(std::vector<Envelope> const& envelopes) {
  Results results;
  results.envelopes = envelopes;
  return envelope_tables(envelope_rows({{"r", results}}));
}

BOOST_AUTO_TEST_CASE(a_row_says_what_held_what_failed_and_how) {
  auto const tables =
      tables_of({driven("conduction/brookshaw", 0.5, std::nullopt), driven("conduction/lucy-flux", 0.8, 0.7),
                 driven("conduction/campbell-flux", std::nullopt, 1.2)});
  BOOST_REQUIRE(tables.size() == 1u);
  TextTable const& table = tables[0];
  BOOST_TEST(table.title.find("smoothing_ratio") != std::string::npos);
  using Row = std::vector<std::string>;
  BOOST_TEST(table.header == (Row{"formulation", "layout", "held to", "failed at", "how"}));
  BOOST_TEST(table.rows[0] == (Row{"brookshaw", "lattice", "0.5", "none", "held to the end"}));
  BOOST_TEST(table.rows[1] == (Row{"lucy-flux", "lattice", "0.8", "0.7", "unstable"}));
  BOOST_TEST(table.rows[2] == (Row{"campbell-flux", "lattice", "none", "1.2", "unstable"}));
}

BOOST_AUTO_TEST_CASE(the_best_held_nearest_to_the_hardest_value) {
  auto const tables =
      tables_of({driven("conduction/brookshaw", 0.6, 0.55), driven("conduction/lucy-flux", 0.8, 0.7)});
  BOOST_TEST(tables[0].best[0][2]);
  BOOST_TEST(!tables[0].best[1][2]);
}

BOOST_AUTO_TEST_CASE(seeds_are_one_row_with_their_range_from_the_worst) {
  auto const tables =
      tables_of({driven("conduction/lucy-flux", 0.7, 0.65, 1), driven("conduction/lucy-flux", 0.9, 0.85, 2)});
  BOOST_REQUIRE(tables[0].rows.size() == 1u);
  BOOST_TEST(tables[0].rows[0][2] == "0.9 .. 0.7");
  BOOST_TEST(tables[0].rows[0].back() == "2");
}

BOOST_AUTO_TEST_CASE(what_was_asked_for_another_hardest_value_has_a_table_of_its_own) {
  Envelope further = driven("conduction/lucy-flux", 0.8, 0.7);
  further.points[0].value = 0.25;
  auto const tables = tables_of({driven("conduction/brookshaw", 0.6, 0.55), further});
  BOOST_REQUIRE(tables.size() == 2u);
  BOOST_TEST(tables[0].title.find("driven towards 0.5,") != std::string::npos);
  BOOST_TEST(tables[1].title.find("driven towards 0.25,") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(csv_and_json_have_an_entry_per_envelope) {
  Results results;
  results.envelopes = {driven("conduction/lucy-flux", 0.7, std::nullopt, 3)};
  auto const rows = envelope_rows({{"r", results}});
  Json const json = envelopes_json(rows);
  BOOST_TEST(json.size() == 1u);
  BOOST_TEST(json[0].at("held") == 0.7);
  BOOST_TEST(json[0].at("to") == 0.5);
  BOOST_TEST(json[0].at("failed").is_null());
  BOOST_TEST(json[0].at("seed") == "3");
  std::string const csv = envelopes_csv(rows);
  BOOST_TEST(csv.starts_with("results,case,"));
  BOOST_TEST(csv.ends_with(",0.5,0.7,\n"), csv);
}

BOOST_AUTO_TEST_SUITE_END()
