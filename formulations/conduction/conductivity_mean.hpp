// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/basics/select.hpp"

namespace sphverify {

/// 2 a b/(a + b), of conductivities on either side of a face: what two resistances in series have together. 0 where both are.
auto harmonic_mean(auto const& a, auto const& b) {
  auto const sum = a + b;
  return select(sum > 0.0, 2.0 * a * b / sum, 0.0);
}

}  // namespace sphverify
