// SPDX-License-Identifier: GPL-3.0-or-later
// What says which files are of which resolution and time (sphverify assess); the files are those beside it.
#include "harness/codes/assess.hpp"
#include "reports/json/results_json.hpp"
#include "tests/fuzz/target.hpp"

namespace sphverify::fuzz {

void take_snapshots(std::string const& file) {
  Json const json = read_json_file(file);
  document_text(to_json(assess(Node(json, file), "-")));
}

}  // namespace sphverify::fuzz
