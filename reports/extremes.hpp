// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <optional>

namespace sphverify {

/// The larger (smaller) of two numbers, and NaN if either is: std::max and std::min keep the one that is
/// known and so hide the other.
inline double larger(double a, double b) { return a > b || std::isnan(a) ? a : b; }
inline double smaller(double a, double b) { return a < b || std::isnan(a) ? a : b; }

/// The larger of two numbers, and none if either does not exist.
template <class T>
std::optional<T> larger_if_known(std::optional<T> const& a, std::optional<T> const& b) {
  if (!a || !b) return std::nullopt;
  return *a > *b ? a : b;
}

}  // namespace sphverify
