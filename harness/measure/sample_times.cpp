// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/sample_times.hpp"

#include <algorithm>
#include <cmath>

namespace sphverify {

std::vector<double> sample_times(double final_time) {
  constexpr int parts = 192;
  constexpr double earliest = 1e-6;
  std::vector<double> times{0.0};
  for (int k = 1; k <= parts; ++k) {
    times.push_back(final_time * std::pow(earliest, 1.0 - (k - 1.0) / (parts - 1.0)));
    times.push_back(final_time * k / parts);
  }
  // Of both the last is to be the end, whatever rounding makes of it.
  for (double& time : times) {
    if (time > final_time * (1.0 - 1e-12)) time = final_time;
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace sphverify
