// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "reports/results.hpp"

namespace sphverify {

/// The norm of that name: l1, l2 or linf.
inline double norm_of(NormSet const& norms, std::string_view name) {
  return name == "l1" ? norms.l1 : name == "l2" ? norms.l2 : norms.linf;
}

}  // namespace sphverify
