// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/gate/measuring.hpp"

#include <fmt/format.h>

#include <cmath>

#include "harness/gate/select.hpp"
#include "harness/gate/text.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

bool Measuring::name(std::string const& key, std::string const& wanted,
                     std::set<std::string> const& existing) {
  Named& named = names_[key];
  named.wanted = wanted;
  named.existing.insert(existing.begin(), existing.end());
  bool const found = existing.contains(wanted);
  named.found = named.found || found;
  return found;
}

void Measuring::require_names() const {
  if (file == nullptr) return;
  for (auto const& [key, named] : names_) {
    if (named.found) continue;
    std::vector<std::string> const existing(named.existing.begin(), named.existing.end());
    throw UserError(*file, gate.key + "." + key, fmt::format("'{}'", without_control(named.wanted)),
                    existing.empty() ? "what the selected runs have measured, which is none of it"
                                     : one_of(named.wanted, existing));
  }
}

bool Measuring::is_reference(FormulationChoice const& formulation) const {
  return !gate.relative_to.id.empty() && matches(gate.relative_to, formulation);
}

void put(Measured& m, Number const& value, std::string const& missing) {
  if (value && std::isfinite(*value)) {
    m.value = value;
  } else {
    m.problem = missing;
  }
}

std::string failure(RunRecord const& run) {
  return run.reason.empty() ? run.status : run.status + ": " + run.reason;
}

}  // namespace sphverify
