// SPDX-License-Identifier: GPL-3.0-or-later
// A results document, in tables, on the page, against gates, and written again.
#include "harness/gate/judge.hpp"
#include "harness/gate/read_gates.hpp"
#include "harness/gate/write_verdicts.hpp"
#include "reports/html/page_data.hpp"
#include "reports/json/results_json.hpp"
#include "reports/table/compare.hpp"
#include "reports/table/sections.hpp"
#include "tests/fuzz/target.hpp"

namespace sphverify::fuzz {

namespace {

void show(std::vector<NamedResults> const& documents) {
  CompareOptions options;
  options.legend = true;
  for (auto const format : {TableFormat::table, TableFormat::markdown, TableFormat::csv, TableFormat::json}) {
    options.style.format = format;
    compare(documents, options);
  }
  for (Section const& section : sections()) {
    options.section = section.name;
    options.style.format = TableFormat::csv;
    compare(documents, options);
  }
  document_text(page_data(documents, {}));
}

}  // namespace

void take_results(std::string const& file) {
  Results const results = read_whole_results(file);
  document_text(to_json(results));
  static Results const others = read_whole_results("results.json");
  show({{"given", results}});
  show({{"before", others}, {"after", results}});
  static Json const json = read_json_file("gates.json");
  static Gates const gates = read_gates(Node(json, "gates.json"));
  verdicts_text(judge(gates, results, read_baselines(gates, file)), false, 80);
}

}  // namespace sphverify::fuzz
