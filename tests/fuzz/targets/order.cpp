// SPDX-License-Identifier: GPL-3.0-or-later
// A table of errors, and what is said of its columns (sphverify order).
#include "harness/measure/ladder_table.hpp"
#include "reports/json/results_json.hpp"
#include "reports/json/series_json.hpp"
#include "tests/fuzz/target.hpp"

namespace sphverify::fuzz {

void take_order(std::string const& file) {
  for (LadderColumn const& column : read_ladder_table(file)) {
    ObservedOrder observed = observed_order(column.levels);
    for (double const target : {0.01, 0.001})
      observed.targets.push_back(resolution_for(observed, target, extent_of(column.levels, 1.0)));
    document_text(to_json(observed));
  }
}

}  // namespace sphverify::fuzz
