// SPDX-License-Identifier: GPL-3.0-or-later
// Results of a part of a study, put together with what another has, and what is missing.
#include "harness/study/context.hpp"
#include "harness/study/merge.hpp"
#include "reports/json/results_json.hpp"
#include "tests/fuzz/target.hpp"

namespace sphverify::fuzz {

void take_part(std::string const& file) {
  std::vector<NamedPart> parts;
  for (std::string const& name : {file, std::string("part-2.json")}) {
    parts.push_back({name, read_results(name)});
    parts.back().results.context = current_context();  // as if this build had made it
    parts.back().results.context.date = "2026-01-01T00:00:00Z";
  }
  Merged const merged = merge_parts(std::move(parts));
  document_text(to_json(merged.rest));
  document_text(to_json(merged.results));
}

}  // namespace sphverify::fuzz
