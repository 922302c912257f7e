// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/cli/controls.hpp"

#include "formulations/rate_operator.hpp"

namespace sphverify {

std::set<std::string> control_ids() {
  std::set<std::string> ids;
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    if (scheme->control) ids.emplace(scheme->id);
  }
  return ids;
}

}  // namespace sphverify
