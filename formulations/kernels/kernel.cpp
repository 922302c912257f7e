#include "formulations/kernels/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "formulations/basics/expects.hpp"
#include "formulations/basics/gauss.hpp"
#include "formulations/kernels/all.hpp"
#include "formulations/kernels/on_piece.hpp"

namespace sphverify {

namespace {

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
ExactPieces times_power(ExactPieces pieces, int n) {
  for (ExactPiece& piece : pieces) {
    OnPiece const q = OnPiece::q(piece.origin, 0.5 * (piece.from + piece.to));
    for (int k = 0; k < n; ++k) piece.function = piece.function * q;
  }
  return pieces;
}

/// int_q^R f dq'
ExactPieces integral_beyond(ExactPieces pieces) {
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

PiecewisePolynomial::Piece rounded(ExactPiece const& exact) {
  PiecewisePolynomial::Piece piece{exact.to, exact.origin, 0, {}};
  for (std::size_t n = 0; n < OnPiece::terms; ++n) {
    piece.coefficient[n] = static_cast<double>(exact.function.coefficient[n]);
    if (piece.coefficient[n] != 0.0) piece.degree = static_cast<int>(n);
  }
  return piece;
}

PiecewisePolynomial rounded(ExactPieces const& exact) {
  std::vector<PiecewisePolynomial::Piece> pieces;
  for (ExactPiece const& piece : exact) pieces.push_back(rounded(piece));
  return PiecewisePolynomial(std::move(pieces));
}

/// Half the length of what a circle of radius `edge` leaves of a line at distance d.
double half_chord(double edge, double d) { return std::sqrt(std::max(0.0, (edge - d) * (edge + d))); }

/// int_0^s q^n ds' along a line at distance d, q^2 = d^2 + s'^2, for n = 0, 1, ...: each from the last but
/// one by parts, with terms that are all positive.
std::array<double, PiecewisePolynomial::terms> powers_along_line(double d, double s, int degree) {
  std::array<double, PiecewisePolynomial::terms> integral{};
  double const q = std::sqrt(d * d + s * s);
  double const d2 = d * d;
  integral[0] = s;
  integral[1] = 0.5 * (s * q + (d > 0.0 ? d2 * std::asinh(s / d) : 0.0));
  double power = q;
  for (int n = 2; n <= degree; ++n) {
    power *= q;
    integral[static_cast<std::size_t>(n)] =
        (s * power + n * d2 * integral[static_cast<std::size_t>(n - 2)]) / (n + 1);
  }
  return integral;
}

/// Integral along a line at distance d over the places from < to, piece by piece of a polynomial of q: the
/// innermost piece by what `inner` says of a part, the others by quadrature of outer(s, q, value). Where the
/// kernel ends q - R = (q^2 - R^2)/(q + R) loses no digits.
template <class Inner, class Outer>
double along_line(PiecewisePolynomial const& polynomials, double d, double from, double to,
                  Inner const& inner, Outer const& outer) {
  double sum = 0.0;
  double reached = 0.0;  // half the chord of the pieces before
  for (PiecewisePolynomial::Piece const& piece : polynomials.pieces()) {
    double const edge = half_chord(piece.to, d);
    if (edge == 0.0) continue;
    auto const add = [&](double part_from, double part_to, auto const& integral) {
      double const lower = std::max(from, part_from);
      double const upper = std::min(to, part_to);
      if (lower < upper) sum += integral(lower, upper);
    };
    if (piece.origin == 0.0) {
      add(-edge, edge, inner);
    } else {
      bool const is_last = piece.origin == piece.to;
      auto const integrand = [&](double s) {
        double const q = std::sqrt(d * d + s * s);
        double const t = is_last ? std::min(0.0, (std::abs(s) - edge) * (std::abs(s) + edge) / (q + piece.to))
                                 : q - piece.origin;
        return outer(q, piece.at_shift(t));
      };
      auto const by_quadrature = [&](double lower, double upper) { return gauss(integrand, lower, upper); };
      add(-edge, -reached, by_quadrature);
      add(reached, edge, by_quadrature);
    }
    reached = edge;
  }
  return sum;
}

}  // namespace

template <class Definition, int Dim>
Kernel Kernel::of() {
  ExactPieces const w = pieces_of<Definition>();
  ExactPieces const moment = integral_beyond(w);
  ExactPieces const first = integral_beyond(times_power(w, 1));
  ExactPieces const second = integral_beyond(times_power(w, 2));
  Kernel made;
  made.info_ = {Definition::id, Definition::title, Definition::source, Definition::equation,
                Definition::support_ratio};
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

double Kernel::line_integral(double d, double from, double to) const {
  PiecewisePolynomial::Piece const& innermost = polynomials_.pieces().front();
  auto const inner = [&](double lower, double upper) {
    auto const at_upper = powers_along_line(d, upper, innermost.degree);
    auto const at_lower = powers_along_line(d, lower, innermost.degree);
    double sum = 0.0;
    for (std::size_t n = 0; n <= static_cast<std::size_t>(innermost.degree); ++n)
      sum += innermost.coefficient[n] * (at_upper[n] - at_lower[n]);
    return sum;
  };
  return along_line(polynomials_, d, from, to, inner, [](double, double w) { return w; });
}

/// On the innermost piece M(q) = M(0) - sum_n c_n q^(n+2)/(n+2): an angle and, again, powers along the line.
double Kernel::hidden_by_line(double d, double from, double to) const {
  PiecewisePolynomial::Piece const& innermost = first_moment_.pieces().front();
  auto const inner = [&](double lower, double upper) {
    auto const at_upper = powers_along_line(d, upper, innermost.degree - 2);
    auto const at_lower = powers_along_line(d, lower, innermost.degree - 2);
    double sum = 0.0;
    for (std::size_t n = 2; n <= static_cast<std::size_t>(innermost.degree); ++n)
      sum += innermost.coefficient[n] * (at_upper[n - 2] - at_lower[n - 2]);
    return innermost.coefficient[0] * (std::atan2(upper, d) - std::atan2(lower, d)) + d * sum;
  };
  return along_line(first_moment_, d, from, to, inner, [d](double q, double M) { return d * M / (q * q); });
}

double Kernel::plane_integral(double d, double h) const {
  double const delta = d / h;
  if (delta >= support_ratio()) return 0.0;
  if (dimension_ == 1) return value(d, h);
  double const edge = half_chord(support_ratio(), delta);
  if (dimension_ == 2) return 2.0 * sigma_ / h * line_integral(delta, 0.0, edge);
  return 2.0 * std::numbers::pi * sigma_ / h * first_moment_(delta);
}

double Kernel::inner_fraction(double d, double h) const {
  double const delta = d / h;
  if (delta >= support_ratio()) return 1.0;
  if (dimension_ == 1) return 1.0 - sigma_ * moment_(delta);
  if (dimension_ == 2) {
    double const edge = half_chord(support_ratio(), delta);
    return 1.0 - 2.0 * sigma_ * hidden_by_line(delta, 0.0, edge);
  }
  return 1.0 - 2.0 * std::numbers::pi * sigma_ * twice_(delta);
}

namespace {

template <int Dim, class... Definitions>
void add_all(std::vector<Kernel>& all, std::tuple<Definitions...> const*) {
  (all.push_back(Kernel::of<Definitions, Dim>()), ...);
}

/// Those of 1, 2 and 3 dimensions, one after the other.
std::vector<Kernel> const& all_kernels() {
  static std::vector<Kernel> const kernels = [] {
    std::vector<Kernel> all;
    add_all<1>(all, static_cast<KernelList<1> const*>(nullptr));
    add_all<2>(all, static_cast<KernelList<2> const*>(nullptr));
    add_all<3>(all, static_cast<KernelList<3> const*>(nullptr));
    return all;
  }();
  return kernels;
}

}  // namespace

Kernel const& kernel(std::string_view id, int dimension) {
  for (Kernel const& one : all_kernels()) {
    if (one.id() == id && one.dimension() == dimension) return one;
  }
  throw std::invalid_argument("no kernel " + std::string(id) + " in " + std::to_string(dimension) +
                              " dimensions");
}

Kernel const& default_kernel(int dimension) { return kernel(CubicSpline<1>::id, dimension); }

std::vector<KernelInfo> const& all_kernel_infos() {
  static std::vector<KernelInfo> const infos = [] {
    std::vector<KernelInfo> all;
    for (Kernel const& one : all_kernels()) {
      if (one.dimension() == 1) all.push_back(one.info());
    }
    return all;
  }();
  return infos;
}

}  // namespace sphverify
