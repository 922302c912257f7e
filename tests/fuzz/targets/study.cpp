// SPDX-License-Identifier: GPL-3.0-or-later
// A study document, up to the runs that it means.
#include "harness/study/study.hpp"
#include "harness/study/expand.hpp"
#include "harness/study/no_effect.hpp"
#include "reports/json/results_json.hpp"
#include "tests/fuzz/target.hpp"

namespace sphverify::fuzz {

void take_study(std::string const& file) {
  Json const json = read_json_file(file);
  Node const document(json, file);
  Study const study = read_study(document);
  require_memory(study, document);
  require_effects(study, document);
  expand(study);
  // What is written of it is read back (merge, repeat).
  Json const again = to_json(study);
  read_study(Node(again, file));
}

}  // namespace sphverify::fuzz
