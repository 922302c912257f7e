#include "harness/scene/list_skin.hpp"

#include <cmath>

namespace sphverify {

double cheapest_skin(double movement, int dimension) {
  double const a = list_cost * movement;
  double const b = (dimension - 1) * a;
  double const skin = (std::sqrt(b * b + 4.0 * dimension * a) - b) / (2.0 * dimension);
  double const cost = std::pow(1.0 + skin, dimension) * (1.0 + a / skin);
  return cost < 1.0 + list_cost ? skin : 0.0;
}

}  // namespace sphverify
