// SPDX-License-Identifier: GPL-3.0-or-later
// The journal of a study that is taken up again: its lines after the first, or all of it if it begins as one.
#include "harness/study/journal.hpp"

#include <fstream>
#include <iterator>

#include "harness/measure/series.hpp"
#include "harness/measure/surface.hpp"
#include "harness/study/expand.hpp"
#include "harness/study/fingerprint.hpp"
#include "reports/json/results_json.hpp"
#include "tests/fuzz/target.hpp"

namespace sphverify::fuzz {

void take_journal(std::string const& file) {
  static Json const json = read_json_file("study.json");
  static Study const study = read_study(Node(json, "study.json"));
  static Json const document = to_json(study);
  static Expansion const expansion = expand(study);
  std::ifstream input(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(input), {});
  if (!text.starts_with(R"({"schema")"))
    text = Json{{"schema", "sphverify-journal/1"}, {"build", fingerprint({})}, {"study", document}}.dump() +
           "\n" + text;
  std::ofstream("results.json.journal", std::ios::binary) << text;

  Journal const journal("results.json.journal", document, true);
  Results results;
  for (std::size_t k = 0; k < expansion.runs.size(); ++k) {
    journal.require_same(k, expansion.runs[k]);
    auto const found = journal.finished().find(k);
    if (found != journal.finished().end()) results.runs.push_back(found->second);
  }
  results.study = document.dump();
  results.series = build_series(results.runs);
  results.surfaces = build_surfaces(results.runs);
  document_text(to_json(results));
}

}  // namespace sphverify::fuzz
