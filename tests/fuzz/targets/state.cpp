// SPDX-License-Identifier: GPL-3.0-or-later
// A state document, and the rates of a form of each kind on it.
#include "harness/evaluate/evaluate.hpp"
#include "reports/json/results_json.hpp"
#include "tests/fuzz/target.hpp"

namespace sphverify::fuzz {

void take_state(std::string const& file) {
  Json const json = read_json_file(file);
  document_text(evaluate_state(
      Node(json, file), {"conduction/brookshaw", "momentum/p-rho2", "work/internal-energy", "momentum/rkgc",
                         "momentum/voronoi", "viscosity/monaghan", "viscosity/riemann"}));
}

}  // namespace sphverify::fuzz
