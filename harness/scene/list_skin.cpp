// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/scene/list_skin.hpp"

#include <cmath>

namespace sphverify {

double cheapest_skin(double movement, int dimension) {
  if (!(movement > 0.0 && movement < 1.0)) return 0.0;
  double const a = list_cost * movement;
  double const b = (dimension - 1) * a;
  double const w = (std::sqrt(b * b + 4.0 * dimension * a * (1.0 - 0.5 * movement)) - b) / (2.0 * dimension);
  double const skin = w - 0.5 * movement;
  if (skin < movement) return 0.0;  // it would serve one place only
  return std::pow(1.0 + skin, dimension) * (1.0 + a / w) < 1.0 + list_cost ? skin : 0.0;
}

}  // namespace sphverify
