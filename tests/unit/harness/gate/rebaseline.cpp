// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/gate/rebaseline.hpp"

#include <boost/test/unit_test.hpp>

#include "reports/json/results_json.hpp"
#include "tests/unit/harness/gate/small_results.hpp"

BOOST_AUTO_TEST_SUITE(harness_gate_rebaseline)

using namespace sphverify;
using namespace sphverify::tests;

struct Place {
  TemporaryFolder folder;
  Gates gates;

  explicit Place(std::string const& gate = R"("measure": "error", "within": {"relative": 0.1},
                                              "baseline": "old.json")") {
    Json const document = gates_document({gate, R"("measure": "status", "equals": "ok")"});
    gates = read_gates(Node(document, folder.file("gates.json")));
  }
  void store(std::vector<RunRecord> const& runs) const {
    write_text(folder.file("old.json"), document_text(to_json(results_of(runs))));
  }
  Rebaseline plan(std::vector<RunRecord> const& runs) const {
    return plan_rebaseline(gates, results_of(runs), folder.file("new.json"));
  }
  std::string refusal(std::vector<RunRecord> const& runs) const {
    return complaint([&] { plan(runs); });
  }
};

RunRecord lucy(double error) { return run_at(25, error, "conduction/lucy-flux"); }

BOOST_AUTO_TEST_CASE(old_new_and_difference_are_shown_of_what_changes) {
  Place const place;
  place.store({run_at(25, 2.0), lucy(1.0)});
  Rebaseline const plan = place.plan({run_at(25, 2.5), lucy(1.0)});
  BOOST_TEST_REQUIRE(plan.paths.size() == 1u);
  BOOST_TEST(plan.paths[0] == place.folder.file("old.json"));
  BOOST_TEST_REQUIRE(plan.changes.size() == 2u);
  BOOST_TEST(*plan.changes[0].before == 2.0);
  BOOST_TEST(*plan.changes[0].after == 2.5);
  std::string const text = rebaseline_text(plan);
  BOOST_TEST(says(text, "2 -> 2.5, +0.5 (+25%): conduction/slab-dirichlet, conduction/brookshaw"), text);
  BOOST_TEST(says(text, "1 of 2 numbers differ from the baseline"), text);
  BOOST_TEST(!says(text, "lucy-flux"), text);
}

BOOST_AUTO_TEST_CASE(what_is_new_and_what_is_lost_is_shown) {
  Place const place;
  place.store({lucy(1.0)});
  std::string const text = rebaseline_text(place.plan({run_at(25, 2.0)}));
  BOOST_TEST(says(text, "none -> 2, new: conduction/slab-dirichlet, conduction/brookshaw"), text);
  BOOST_TEST(says(text, "1 -> none, lost: conduction/slab-dirichlet, conduction/lucy-flux"), text);
}

BOOST_AUTO_TEST_CASE(a_first_baseline_needs_no_old_one) {
  Place const place;
  Rebaseline const plan = place.plan({run_at(25, 2.0)});
  BOOST_TEST(!plan.changes.at(0).before.has_value());
  BOOST_TEST(!std::filesystem::exists(place.folder.file("old.json")), "a plan writes nothing");
}

BOOST_AUTO_TEST_CASE(a_baseline_without_a_number_for_its_gates_is_refused) {
  Place const place;
  BOOST_TEST(
      says(place.refusal({failed_at(25)}), "found unstable: the temperature ran away, expected a number"));
  BOOST_TEST(says(place.refusal({}), "gates[0].select: found the results hold no run"));
  Place const none(R"("measure": "error", "maximum": 1)");
  BOOST_TEST(says(none.refusal({run_at(25, 1.0)}), "no gate with a baseline"));
}

BOOST_AUTO_TEST_SUITE_END()
