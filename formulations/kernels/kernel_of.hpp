// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "formulations/basics/expects.hpp"
#include "formulations/kernels/kernel.hpp"
#include "formulations/kernels/on_piece.hpp"
#include "formulations/sweep/loops.hpp"

// How a kernel's header becomes a Kernel.
namespace sphverify {

namespace exact {

static_assert(OnPiece::terms == PiecewisePolynomial::terms);

/// A piece of a kernel's support and a polynomial on it.
struct ExactPiece {
  double from, to, origin;
  OnPiece function;

  /// Its value at its end and at its beginning.
  long double at_end() const { return function.at_shift(static_cast<long double>(to) - origin); }
  long double at_beginning() const { return function.at_shift(static_cast<long double>(from) - origin); }
};
using ExactPieces = std::vector<ExactPiece>;

/// The polynomials of a kernel's shape, from one whole q to the next.
template <class Definition>
ExactPieces pieces_of() {
  constexpr int count = static_cast<int>(Definition::support_ratio);
  static_assert(count == Definition::support_ratio, "a kernel's pieces and its support end at whole q");
  ExactPieces pieces;
  for (int k = 0; k < count; ++k) {
    double const from = k;
    double const to = k + 1;
    // At the edge of the support the shape is a power of the distance from it, which keeps all digits.
    double const origin = k + 1 == count ? to : (k == 0 ? 0.0 : 0.5 * (from + to));
    pieces.push_back({from, to, origin, Definition::shape(OnPiece::q(origin, 0.5 * (from + to)))});
  }
  return pieces;
}

/// f q^n
inline ExactPieces times_power(ExactPieces pieces, int n) {
  for (ExactPiece& piece : pieces) {
    OnPiece const q = OnPiece::q(piece.origin, 0.5 * (piece.from + piece.to));
    for (int k = 0; k < n; ++k) piece.function = piece.function * q;
  }
  return pieces;
}

/// int_q^R f dq'
inline ExactPieces integral_beyond(ExactPieces pieces) {
  long double at_end = 0.0L;
  for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece) {
    OnPiece integral(0.0);
    for (std::size_t n = 0; n + 1 < OnPiece::terms; ++n)
      integral.coefficient[n + 1] = -piece->function.coefficient[n] / static_cast<long double>(n + 1);
    expects(piece->function.coefficient.back() == 0.0L);
    piece->function = integral;
    piece->function.coefficient[0] = at_end - piece->at_end();
    at_end = piece->at_beginning();
  }
  return pieces;
}

inline PiecewisePolynomial::Piece rounded(ExactPiece const& exact) {
  PiecewisePolynomial::Piece piece{exact.to, exact.origin, 0, {}};
  for (std::size_t n = 0; n < OnPiece::terms; ++n) {
    piece.coefficient[n] = static_cast<double>(exact.function.coefficient[n]);
    if (piece.coefficient[n] != 0.0) piece.degree = static_cast<int>(n);
  }
  return piece;
}

inline PiecewisePolynomial rounded(ExactPieces const& exact) {
  std::vector<PiecewisePolynomial::Piece> pieces;
  for (ExactPiece const& piece : exact) pieces.push_back(rounded(piece));
  return PiecewisePolynomial(std::move(pieces));
}

}  // namespace exact

template <class Definition, int Dim>
Kernel Kernel::of() {
  using namespace exact;
  ExactPieces const w = pieces_of<Definition>();
  ExactPieces const moment = integral_beyond(w);
  ExactPieces const first = integral_beyond(times_power(w, 1));
  ExactPieces const second = integral_beyond(times_power(w, 2));
  Kernel made;
  made.info_ = {Definition::id, Definition::title, Definition::source, Definition::equation,
                Definition::support_ratio};
  made.columns_ = columns_of_kernel<Definition, Dim>();
  made.dimension_ = Dim;
  made.sigma_ = Definition::sigma;
  made.value_ = [](double r, double h) { return Definition::value(r, h); };
  made.radial_ = [](double r, double h) { return Definition::radial(r, h); };
  made.shape_ = [](double q) { return Definition::shape(q); };
  for (std::size_t k = 0; k + 1 < w.size(); ++k) made.knots_.push_back(w[k].to);
  made.polynomials_ = rounded(w);
  made.moment_ = rounded(moment);
  made.first_moment_ = rounded(first);
  made.second_moment_ = rounded(second);
  made.twice_ = rounded(integral_beyond(first));
  made.whole_second_moment_ = static_cast<double>(second.front().at_beginning());
  // The pole is gone: int_0^q w q'^2 dq' has no constant term, and its powers are those of q.
  ExactPiece potential = first.front();
  expects(potential.origin == 0.0);
  OnPiece const& within = second.front().function;
  potential.function = -potential.function;
  for (std::size_t n = 0; n + 1 < OnPiece::terms; ++n)
    potential.function.coefficient[n] += within.coefficient[n + 1];
  made.inner_potential_ = rounded(potential);
  return made;
}

/// What to hand to add_kernel.
template <template <int> class Definition>
KernelPart kernel_part() {
  return {Kernel::of<Definition<1>, 1>(), Kernel::of<Definition<2>, 2>(), Kernel::of<Definition<3>, 3>()};
}

}  // namespace sphverify
