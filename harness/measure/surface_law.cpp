// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/surface_law.hpp"

#include <algorithm>
#include <cmath>

namespace sphverify {

double sampling_slope(std::vector<SamplingAtRatio> const& sampling) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  double const n = static_cast<double>(sampling.size());
  for (SamplingAtRatio const& s : sampling) {
    x += std::log(s.ratio) / n;
    y += std::log(s.coefficient) / n;
  }
  for (SamplingAtRatio const& s : sampling) {
    double const from_mean = std::log(s.ratio) - x;
    xx += from_mean * from_mean;
    xy += from_mean * (std::log(s.coefficient) - y);
  }
  return xx > 0.0 ? -xy / xx : 0.0;
}

double surface_error(SurfaceLaw const& law, double spacing, double ratio) {
  double const d = spacing / law.unit;
  double const smoothing = law.smoothing_coefficient > 0.0
                               ? law.smoothing_coefficient * std::pow(ratio * d, law.smoothing_exponent)
                               : 0.0;
  double sampling = 0.0;
  if (law.sampling.size() == 1) sampling = law.sampling.front().coefficient;
  if (law.sampling.size() > 1) {
    auto above = std::lower_bound(law.sampling.begin(), law.sampling.end(), ratio,
                                  [](SamplingAtRatio const& s, double r) { return s.ratio < r; });
    above = std::clamp(above, law.sampling.begin() + 1, law.sampling.end() - 1);
    auto const below = above - 1;
    double const part = std::log(ratio / below->ratio) / std::log(above->ratio / below->ratio);
    sampling = below->coefficient * std::pow(above->coefficient / below->coefficient, part);
  } else if (law.sampling.empty() && law.sampling_coefficient > 0.0) {
    sampling = law.sampling_coefficient * std::pow(ratio, -law.sampling_exponent);
  }
  if (law.spacing_exponent != 0.0) sampling *= std::pow(d, law.spacing_exponent);
  double const square =
      smoothing * smoothing + sampling * sampling + 2.0 * law.correlation * smoothing * sampling;
  return law.floor + std::sqrt(std::max(square, 0.0));
}

}  // namespace sphverify
