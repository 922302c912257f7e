// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

namespace sphverify {

/// Integral of f by Gauss's 16 points.
template <class Function>
double gauss(Function const& f, double from, double to) {
  constexpr std::array<double, 8> node{0.0950125098376374402, 0.281603550779258913, 0.458016777657227386,
                                       0.617876244402643748,  0.755404408355003034, 0.865631202387831744,
                                       0.944575023073232576,  0.989400934991649933};
  constexpr std::array<double, 8> weight{0.189450610455068496,  0.182603415044923589, 0.169156519395002538,
                                         0.149595988816576732,  0.124628971255533872, 0.0951585116824927848,
                                         0.0622535239386478929, 0.0271524594117540949};
  double const centre = 0.5 * (from + to);
  double const half = 0.5 * (to - from);
  double sum = 0.0;
  for (std::size_t k = 0; k < node.size(); ++k) {
    sum += weight[k] * (f(centre - half * node[k]) + f(centre + half * node[k]));
  }
  return half * sum;
}

}  // namespace sphverify
