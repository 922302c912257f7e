// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/gate/read_gates.hpp"

#include <boost/test/unit_test.hpp>

#include "tests/unit/harness/gate/small_results.hpp"

BOOST_AUTO_TEST_SUITE(harness_gate_read_gates)

using namespace sphverify;
using namespace sphverify::tests;

std::string refusal(Json const& document) {
  return complaint([&] { read(document); });
}

std::string refusal_of(std::string const& gate) { return refusal(gates_document({gate})); }

std::string const ok = R"("measure": "status", "equals": "ok")";

BOOST_AUTO_TEST_CASE(the_gates_of_the_contract_are_read) {
  Json const document = Json::parse(R"({"schema": "sphverify-gates/1", "gates": [
    {"name": "brookshaw converges",
     "select": {"case": "conduction/slab-dirichlet", "formulation": "conduction/brookshaw"},
     "measure": "order", "field": "temperature", "norm": "l2", "region": "all", "minimum": 0.7},
    {"name": "two-pass on disorder",
     "select": {"formulation": "conduction/campbell-flux", "discretisation": {"layout": "jittered"}},
     "measure": "status", "equals": "ok", "expect": "fail", "reason": "growing modes: see docs"}]})");
  Gates const gates = read(document);
  BOOST_TEST_REQUIRE(gates.gates.size() == 2u);
  BOOST_TEST(gates.name == "gates");
  Gate const& order = gates.gates[0];
  BOOST_TEST((order.measure == GateMeasure::order));
  BOOST_TEST(order.field == "temperature");
  BOOST_TEST(*order.limit.minimum == 0.7);
  BOOST_TEST(order.interval_decides);
  BOOST_TEST(!order.expect_failure);
  Gate const& status = gates.gates[1];
  BOOST_TEST(status.limit.equals_word == "ok");
  BOOST_TEST(status.expect_failure);
  BOOST_TEST(status.reason == "growing modes: see docs");
  BOOST_TEST(status.select.layouts.at(0).id == "jittered");
  BOOST_TEST(status.key == "gates[1]");
}

BOOST_AUTO_TEST_CASE(defaults_follow_the_measure) {
  BOOST_TEST((gate_of(R"("measure": "error", "maximum": 1)").levels == LevelChoice::finest));
  BOOST_TEST((gate_of(ok).levels == LevelChoice::all));
  Gate const budget = gate_of(R"("measure": "conservation", "maximum": 1)");
  BOOST_TEST((budget.levels == LevelChoice::all));
  BOOST_TEST(budget.quantity == "energy");
  BOOST_TEST(budget.what == "drift");
  BOOST_TEST(budget.relative);
  BOOST_TEST(gate_of(R"("measure": "wall_flux", "maximum": 1)").relative);
  BOOST_TEST(!gate_of(R"("measure": "error", "maximum": 1)").relative);
  BOOST_TEST((gate_of(R"("measure": "stability", "maximum": 1)").quantity == "spectral_abscissa"));
  Gate const cost = gate_of(R"("measure": "cost", "maximum": 1, "relative_to": "conduction/lucy-flux")");
  BOOST_TEST(cost.quantity == "seconds");
  BOOST_TEST((cost.levels == LevelChoice::finest));
  BOOST_TEST((gate_of(R"("measure": "skill", "maximum": 1)").levels == LevelChoice::finest));
  BOOST_TEST((gate_of(R"("measure": "time_error", "maximum": 1)").levels == LevelChoice::all));
  Gate const order = gate_of(R"("measure": "order", "minimum": 1)");
  BOOST_TEST(order.verdict_decides);
  BOOST_TEST(!order.count.exactly.has_value());
  BOOST_TEST(!order.count.at_least.has_value());
  BOOST_TEST(!gate_of(R"("measure": "order", "minimum": 1, "verdict": "ignore")").verdict_decides);
  BOOST_TEST(*gate_of(ok + R"(, "runs": 3)").count.exactly == 3u);
  BOOST_TEST(*gate_of(ok + R"(, "at_least": 3)").count.at_least == 3u);
  Gate const one = gate_of(R"("measure": "error", "maximum": 1, "resolution": 50)");
  BOOST_TEST((one.levels == LevelChoice::one));
  BOOST_TEST(one.resolution == 50);
}

BOOST_AUTO_TEST_CASE(every_wrong_gate_is_refused_with_its_key) {
  struct {
    std::string gate, key, expected;
  } const wrong[] = {
      {R"("measure": "eror", "maximum": 1)", "gates[0].measure", "did you mean 'error'?"},
      {R"("measure": "error", "maximun": 1)", "gates[0].maximun", "did you mean 'maximum'?"},
      {R"("measure": "error", "maximum": "1")", "gates[0].maximum", "a number"},
      {R"("measure": "error", "maximum": null)", "gates[0].maximum", "a number"},
      {R"("measure": "error")", "gates[0]", "minimum and/or maximum, or equals, or within"},
      {R"("measure": "error", "maximum": 1, "equals": 1)", "gates[0]", "limits of several kinds"},
      {R"("measure": "error", "minimum": 2, "maximum": 1)", "gates[0].minimum", "at most the maximum"},
      {R"("measure": "error", "maximum": 1, "norm": "l3")", "gates[0].norm", "one of l1, l2, linf"},
      {R"("measure": "error", "maximum": 1, "resolution": 0)", "gates[0].resolution", "a whole number"},
      {R"("measure": "error", "maximum": 1, "resolution": "coarsest")", "gates[0].resolution", "finest"},
      {R"("measure": "error", "maximum": 1, "relative_to": "conduction/lucy-flux")", "gates[0].relative_to",
       "an unknown key"},
      {R"("measure": "status", "maximum": 1)", "gates[0].maximum", "a status under equals"},
      {R"("measure": "status", "equals": "fine")", "gates[0].equals", "one of ok"},
      {R"("measure": "order", "equals": 2)", "gates[0].equals", "asymptotic"},
      {R"("measure": "order", "minimum": 1, "interval": "maybe")", "gates[0].interval", "ignore"},
      {R"("measure": "order", "minimum": 1, "select": {"resolution": 50})", "gates[0].select.resolution",
       "whole ladder"},
      {R"("measure": "order", "minimum": 1,
          "select": {"discretisation": {"layout": {"id": "jittered", "seed": 1}}})",
       "gates[0].select.discretisation.layout", "whole ladder"},
      {R"("measure": "conservation", "quantity": "charge", "maximum": 1)", "gates[0].quantity", "mass"},
      {R"("measure": "conservation", "what": "leak", "maximum": 1)", "gates[0].what", "pair_drift"},
      {R"("measure": "stability", "quantity": "noise", "maximum": 1)", "gates[0].quantity",
       "spectral_abscissa"},
      {R"("measure": "cost", "maximum": 1)", "gates[0].relative_to", "ratios only"},
      {R"("measure": "time_to_error", "maximum": 1)", "gates[0].relative_to", "ratios only"},
      {R"("measure": "time_to_error", "maximum": 1, "target": 0, "relative_to": "x/y")", "gates[0].target",
       "a positive number"},
      {R"("measure": "error", "within": {"relative": 0.1})", "gates[0].baseline", "a results file"},
      {R"("measure": "error", "within": {}, "baseline": "b.json")", "gates[0].within", "relative, absolute"},
      {R"("measure": "error", "within": {"relative": -1}, "baseline": "b.json")", "gates[0].within.relative",
       "0 or more"},
      {R"("measure": "error", "maximum": 1, "baseline": "b.json")", "gates[0].baseline", "beside within"},
      {ok + R"(, "expect": "fail")", "gates[0].reason", "this key"},
      {ok + R"(, "expect": "fail", "reason": " ")", "gates[0].reason", "a text of one line"},
      {ok + R"(, "reason": "why")", "gates[0].reason", "beside"},
      {ok + R"(, "expect": "fial", "reason": "why")", "gates[0].expect", "did you mean 'fail'?"},
      {ok + R"(, "name": "a\nb")", "gates[0].name", "a text of one line"},
      {ok + R"(, "select": {"formulations": "x"})", "gates[0].select.formulations",
       "did you mean 'formulation'?"},
      {ok + R"(, "select": {"case": {"id": "x", "degree": 1}})", "gates[0].select.case.degree", "parameters"},
      {ok + R"(, "select": {"case": []})", "gates[0].select.case", "at least one"},
      {ok + R"(, "select": {"discretisation": {"densty": "given"}})", "gates[0].select.discretisation.densty",
       "did you mean 'density'?"},
      {ok + R"(, "select": {"walls": "no"})", "gates[0].select.walls", "one of on, off"},
      {ok + R"(, "select": {"walls": "on", "formulation": {"id": "x", "walls": "off"}})",
       "gates[0].select.walls", "either here or in formulation"},
      {ok + R"(, "select": 3)", "gates[0].select", "an object"},
      {ok + R"(, "runs": 0)", "gates[0].runs", "a whole number"},
      {ok + R"(, "at_least": 1.5)", "gates[0].at_least", "a whole number"},
      {ok + R"(, "runs": 2, "at_least": 1)", "gates[0].at_least", "'runs' or this key"},
      {ok + R"(, "verdict": "ignore")", "gates[0].verdict", "an unknown key"},
      {R"("measure": "order", "minimum": 1, "verdict": "maybe")", "gates[0].verdict", "ignore"},
      {R"("measure": "order", "equals": "floored", "verdict": "ignore")", "gates[0].verdict",
       "only beside a limit that is a number"},
      {R"("measure": "skill", "maximum": 1, "relative": true)", "gates[0].relative", "an unknown key"},
      {R"("measure": "time_error", "maximum": 1, "field": "temperature")", "gates[0].field",
       "an unknown key"},
  };
  for (auto const& one : wrong) {
    std::string const said = refusal_of(one.gate);
    BOOST_TEST(says(said, "gates.json: " + one.key + ": found "), one.gate << " -> " << said);
    BOOST_TEST(says(said, one.expected), one.gate << " -> " << said);
    BOOST_TEST(!says(said, "\n"), said);
  }
}

BOOST_AUTO_TEST_CASE(the_document_itself_is_checked) {
  BOOST_TEST(says(refusal(Json::parse(R"({"schema": "sphverify-gates/2", "gates": []})")), "schema: found"));
  BOOST_TEST(says(refusal(gates_document({})), "gates: found an empty list"));
  BOOST_TEST(says(refusal(gates_document({ok + R"(, "name": "a")", ok + R"(, "name": "a")"})),
                  "gates[1].name: found 'a', expected every name only once"));
  Json document = gates_document({ok});
  document["gate"] = 1;
  BOOST_TEST(says(refusal(document), "did you mean 'gates'?"));
}

BOOST_AUTO_TEST_CASE(a_baseline_is_meant_from_where_the_gates_stand_and_may_be_common) {
  std::string const within = R"("measure": "error", "within": {"relative": 0.1})";
  Json document = gates_document({within, within + R"(, "baseline": "../own.json")", ok});
  document["baseline"] = "b/common.json";
  Gates const gates = read_gates(Node(document, "some/folder/gates.json"));
  BOOST_TEST(gates.gates[0].limit.baseline == "some/folder/b/common.json");
  BOOST_TEST(gates.gates[1].limit.baseline == "some/own.json");
  BOOST_TEST(gates.gates[2].limit.baseline.empty());
}

BOOST_AUTO_TEST_CASE(an_unknown_key_is_named_before_a_missing_one) {
  std::string const said = refusal_of(R"("maximun": 1)");
  BOOST_TEST(said.find("gates[0].maximun: found an unknown key") != std::string::npos, said);
  BOOST_TEST(said.find("did you mean 'maximum'?") != std::string::npos, said);
  std::string const lacks = refusal_of(R"("maximum": 1, "verdict": "ignore")");
  BOOST_TEST(lacks.find("gates[0].measure: found nothing") != std::string::npos, lacks);
}

BOOST_AUTO_TEST_SUITE_END()
