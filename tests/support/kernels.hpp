// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "tests/support/quadrature.hpp"

// Every kernel written down a second time: as truncated powers, or by u = r/H with H the support, as Dehnen &
// Aly (2012, Table 1) have them; normalised by quadrature.
namespace sphverify::tests::written {

/// Support in smoothing lengths.
inline double support(std::string_view id) { return id == "quintic-spline" ? 3.0 : 2.0; }

inline long double power(long double x, int n) { return n == 0 ? 1.0L : x * power(x, n - 1); }

/// Shape in long double, q and its distance p = support - q from the edge given both: where one of the two is
/// small it keeps its digits.
inline long double shape(std::string_view id, int dimension, long double q, long double p) {
  if (p <= 0.0L) return 0.0L;
  auto const cut = [](long double x) { return std::max(x, 0.0L); };
  if (id == "cubic-spline") return (power(p, 3) - 4.0L * power(cut(1.0L - q), 3)) / 4.0L;
  if (id == "quintic-spline")
    return power(p, 5) - 6.0L * power(cut(2.0L - q), 5) + 15.0L * power(cut(1.0L - q), 5);
  long double const u = q / 2.0L;
  long double const v = p / 2.0L;
  if (dimension == 1) {
    if (id == "wendland-c2") return power(v, 3) * (1.0L + 3.0L * u);
    if (id == "wendland-c4") return power(v, 5) * (1.0L + 5.0L * u + 8.0L * u * u);
    if (id == "wendland-c6") return power(v, 7) * (1.0L + 7.0L * u + 19.0L * u * u + 21.0L * u * u * u);
  } else {
    if (id == "wendland-c2") return power(v, 4) * (1.0L + 4.0L * u);
    if (id == "wendland-c4") return power(v, 6) * (1.0L + 6.0L * u + 35.0L / 3.0L * u * u);
    if (id == "wendland-c6") return power(v, 8) * (1.0L + 8.0L * u + 25.0L * u * u + 32.0L * u * u * u);
  }
  throw std::invalid_argument("no second form of " + std::string(id));
}
inline long double shape(std::string_view id, int dimension, long double q) {
  return shape(id, dimension, q, static_cast<long double>(support(id)) - q);
}

/// Integral over [from, to], both in smoothing lengths, of f, which is smooth between whole numbers.
template <class Function>
double between_knots(Function const& f, double from, double to) {
  double sum = 0.0;
  for (double next; from < to; from = next) {
    next = std::min(to, std::floor(from) + 1.0);
    sum += quadrature(f, from, next);
  }
  return sum;
}

inline double sigma(std::string_view id, int dimension) {
  static std::map<std::pair<std::string, int>, double> known;
  auto const [found, is_new] = known.try_emplace({std::string(id), dimension}, 0.0);
  if (is_new) {
    constexpr double whole_angle[] = {2.0, 2.0 * std::numbers::pi, 4.0 * std::numbers::pi};
    auto const shell = [&](double q) {
      return static_cast<double>(shape(id, dimension, q)) * std::pow(q, dimension - 1);
    };
    found->second = 1.0 / (whole_angle[dimension - 1] * between_knots(shell, 0.0, support(id)));
  }
  return found->second;
}

/// W(r, h)
inline double kernel(std::string_view id, int dimension, double r, double h) {
  return sigma(id, dimension) / std::pow(h, dimension) * static_cast<double>(shape(id, dimension, r / h));
}

/// Half of what a circle of radius `edge` leaves of a line at distance d.
inline double half_chord(double edge, double d) {
  return d < edge ? std::sqrt((edge - d) * (edge + d)) : 0.0;
}

/// Integral of W over a plane at distance d, in rings; h = 1. With p = (R^2 - q^2)/(R + q) all digits stay up
/// to the edge of the support.
inline double plane_integral(std::string_view id, int dimension, double d) {
  double const R = support(id);
  if (d >= R) return 0.0;
  if (dimension == 1) return sigma(id, 1) * static_cast<double>(shape(id, 1, d));
  double const edge = half_chord(R, d);
  auto const ring = [&](double t) {  // s = t edge
    double const q = std::hypot(d, t * edge);
    double const p = edge * edge * (1.0 - t) * (1.0 + t) / (R + q);
    return edge * (dimension == 2 ? 2.0 : 2.0 * std::numbers::pi * t * edge) *
           static_cast<double>(shape(id, dimension, q, p));
  };
  double sum = 0.0;
  double reached = 0.0;
  for (double end = std::floor(d) + 1.0; end <= R; end += 1.0) {
    double const next = half_chord(end, d) / edge;
    sum += quadrature(ring, reached, next);
    reached = next;
  }
  return sigma(id, dimension) * sum;
}

/// Part of the kernel on this side of a plane at distance d: 1 less the integral over the shells beyond it; h
/// = 1.
inline double inner_fraction(std::string_view id, int dimension, double d) {
  double const R = support(id);
  auto const beyond = [&](double q) {
    double const measure = dimension == 1   ? 1.0
                           : dimension == 2 ? 2.0 * q * std::acos(std::min(1.0, d / q))
                                            : 2.0 * std::numbers::pi * q * (q - d);
    return measure * static_cast<double>(shape(id, dimension, q));
  };
  double sum = 0.0;
  for (double from = d, to; from < R; from = to) {
    to = std::floor(from) + 1.0;
    // With q = from + (to - from) u^2 the root at an arc's start does no harm.
    sum += quadrature([&](double u) { return 2.0 * u * (to - from) * beyond(from + (to - from) * u * u); },
                      0.0, 1.0);
  }
  return 1.0 - sigma(id, dimension) * sum;
}

}  // namespace sphverify::tests::written
