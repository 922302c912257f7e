// SPDX-License-Identifier: GPL-3.0-or-later
// Somebody's own rates, compared with ours (sphverify evaluate --against).
#include "harness/evaluate/against.hpp"
#include "harness/evaluate/evaluate.hpp"
#include "reports/json/results_json.hpp"
#include "tests/fuzz/target.hpp"

namespace sphverify::fuzz {

void take_rates(std::string const& file) {
  static Json const state = read_json_file("state.json");
  static Json const ours = evaluate_state(Node(state, "state.json"));
  Json const theirs = read_json_file(file);
  Node const node(theirs, file);
  schemes_in(node);
  Json lists = Json::array();
  for (RateComparison const& one : compare_rates(node, ours, 1e-12)) lists.push_back(to_json(one));
  document_text(lists);
}

}  // namespace sphverify::fuzz
