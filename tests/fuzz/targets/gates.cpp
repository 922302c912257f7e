// SPDX-License-Identifier: GPL-3.0-or-later
// A gates document: measures, selectors and limits, judged on results that have all measures.
#include "harness/gate/judge.hpp"
#include "harness/gate/read_gates.hpp"
#include "harness/gate/rebaseline.hpp"
#include "harness/gate/write_verdicts.hpp"
#include "reports/json/results_json.hpp"
#include "tests/fuzz/target.hpp"

namespace sphverify::fuzz {

void take_gates(std::string const& file) {
  static Results const results = read_whole_results("results.json");
  Json const json = read_json_file(file);
  Gates const gates = read_gates(Node(json, file));
  auto const verdicts = judge(gates, results, read_baselines(gates, "results.json"));
  verdicts_text(verdicts, false, 80);
  verdicts_markdown(gates, verdicts);
  verdicts_junit(gates, verdicts);
  verdicts_annotations(gates, verdicts);
  rebaseline_text(plan_rebaseline(gates, results, "results.json"));
}

}  // namespace sphverify::fuzz
