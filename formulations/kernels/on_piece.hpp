// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "formulations/basics/expects.hpp"

namespace sphverify {

/// A function of q on a piece on which it is a polynomial, sum_n coefficient[n] (q - origin)^n. A kernel's
/// own formula for its shape, given q(), makes the polynomial of the shape: comparisons in it, which must
/// come out the same on all of the piece, are decided by the value at one place within. Computed in long
/// double, once per kernel.
struct OnPiece {
  static constexpr std::size_t terms = 16;

  std::array<long double, terms> coefficient{};
  long double within;  ///< value at some place within the piece

  OnPiece(double constant) : within(constant) { coefficient[0] = constant; }

  /// q itself.
  static OnPiece q(double origin, double within) {
    OnPiece result(origin);
    result.coefficient[1] = 1.0L;
    result.within = within;
    return result;
  }

  friend OnPiece operator+(OnPiece a, OnPiece const& b) {
    for (std::size_t n = 0; n < terms; ++n) a.coefficient[n] += b.coefficient[n];
    a.within += b.within;
    return a;
  }
  friend OnPiece operator-(OnPiece a) {
    for (long double& c : a.coefficient) c = -c;
    a.within = -a.within;
    return a;
  }
  friend OnPiece operator-(OnPiece const& a, OnPiece const& b) { return a + -b; }
  friend OnPiece operator*(OnPiece const& a, OnPiece const& b) {
    OnPiece product(0.0);
    for (std::size_t n = 0; n < terms; ++n) {
      if (a.coefficient[n] == 0.0L) continue;
      for (std::size_t m = 0; m < terms; ++m) {
        if (b.coefficient[m] == 0.0L) continue;
        expects(n + m < terms);
        product.coefficient[n + m] += a.coefficient[n] * b.coefficient[m];
      }
    }
    product.within = a.within * b.within;
    return product;
  }
  friend bool operator<(OnPiece const& a, OnPiece const& b) { return a.within < b.within; }
  friend OnPiece max(OnPiece const& a, OnPiece const& b) { return a < b ? b : a; }
  friend OnPiece select(bool condition, OnPiece const& yes, OnPiece const& no) {
    return condition ? yes : no;
  }

  long double at_shift(long double t) const {
    long double sum = 0.0L;
    for (std::size_t n = terms; n-- > 0;) sum = coefficient[n] + t * sum;
    return sum;
  }
};

}  // namespace sphverify
