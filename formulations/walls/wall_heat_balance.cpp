// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/walls/wall_heat_balance.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

namespace sphverify {

double balanced_wall_temperature(HeatLoss const& loss, double temperature, double conductance) {
  if (!std::isfinite(temperature) || !std::isfinite(loss.flux(temperature)))
    return std::numeric_limits<double>::quiet_NaN();
  if (!(conductance > 0.0)) return loss.environment;
  auto const excess = [&](double T) { return conductance * (T - temperature) + loss.flux(T); };
  double const low = std::min(temperature, loss.environment);
  double const high = std::max(temperature, loss.environment);
  double const at_low = excess(low);
  double const at_high = excess(high);
  if (at_low >= 0.0) return low;
  if (at_high <= 0.0) return high;
  std::uintmax_t steps = 100;
  auto const [from, to] = boost::math::tools::toms748_solve(
      excess, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(), steps);
  return 0.5 * (from + to);
}

}  // namespace sphverify
