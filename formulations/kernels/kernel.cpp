// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/kernels/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "formulations/basics/expects.hpp"
#include "formulations/basics/gauss.hpp"
#include "formulations/kernels/all.hpp"
#include "formulations/kernels/kernel_of.hpp"

namespace sphverify {

namespace {

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

template <template <int> class... Definitions>
std::vector<KernelPart> parts_of_all(KernelPack<Definitions...>) {
  return {kernel_part<Definitions>()...};
}

std::deque<KernelPart>& parts() {
  static std::deque<KernelPart> all = [] {
    std::vector<KernelPart> const ours = parts_of_all(AllKernels());
    return std::deque<KernelPart>(ours.begin(), ours.end());
  }();
  return all;
}

KernelPart const* find_part(std::string_view id) {
  for (KernelPart const& part : parts()) {
    if (part.front().id() == id) return &part;
  }
  return nullptr;
}

}  // namespace

void add_kernel(KernelPart const& part) {
  std::string const id(part.front().id());
  if (find_part(id)) throw std::invalid_argument("two kernels are called " + id);
  parts().push_back(part);
}

Kernel const& kernel(std::string_view id, int dimension) {
  KernelPart const* const part = dimension >= 1 && dimension <= 3 ? find_part(id) : nullptr;
  if (part) return (*part)[static_cast<std::size_t>(dimension - 1)];
  throw std::invalid_argument("no kernel " + std::string(id) + " in " + std::to_string(dimension) +
                              " dimensions");
}

Kernel const& default_kernel(int dimension) { return kernel(CubicSpline<1>::id, dimension); }

std::vector<KernelInfo> all_kernel_infos() {
  std::vector<KernelInfo> all;
  for (KernelPart const& part : parts()) all.push_back(part.front().info());
  return all;
}

}  // namespace sphverify
