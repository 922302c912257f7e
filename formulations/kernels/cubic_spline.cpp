#include "formulations/kernels/cubic_spline.hpp"

#include <algorithm>
#include <array>

namespace sphverify {

namespace {

/// The spline's shape on q in [from, to] as a polynomial sum_n coefficient[n] q^n.
struct Piece {
  double from, to;
  std::array<double, 4> coefficient;
};
constexpr std::array<Piece, 2> pieces{
    {{0.0, 1.0, {1.0, 0.0, -1.5, 0.75}}, {1.0, 2.0, {2.0, -3.0, 1.5, -0.25}}}};

/// Antiderivative by q of q^(n+1)/sqrt(q^2 - delta^2) for n = 0..3, zero at q = delta.
std::array<double, 4> chord_moments(double q, double delta) {
  double const s = std::sqrt(std::max(0.0, (q - delta) * (q + delta)));
  double const d2 = delta * delta;
  double const d2_log = delta > 0.0 ? d2 * std::asinh(s / delta) : 0.0;  // acosh(q/delta)
  return {s, 0.5 * (q * s + d2_log), s * (s * s / 3.0 + d2),
          0.25 * q * q * q * s + 0.375 * d2 * (q * s + d2_log)};
}

/// The same where the closed form is a small difference of large terms: with s = t edge along the line and
/// 2 - q = (4 - q^2)/(2 + q) the integrand loses no digits, and is so smooth that 8 Gauss points suffice.
double line_integral_2d_near_edge(double delta) {
  constexpr std::array<double, 4> node{0.18343464249564980, 0.52553240991632899, 0.79666647741362674,
                                       0.96028985649753623};
  constexpr std::array<double, 4> weight{0.36268378337836198, 0.31370664587788729, 0.22238103445337447,
                                         0.10122853629037626};
  double const squared_edge = (2.0 - delta) * (2.0 + delta);
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    for (double const t : {0.5 - 0.5 * node[k], 0.5 + 0.5 * node[k]}) {
      double const p = squared_edge * (1.0 - t * t) / (2.0 + std::sqrt(delta * delta + squared_edge * t * t));
      sum += 0.5 * weight[k] * p * p * p;
    }
  }
  return 0.25 * std::sqrt(squared_edge) * sum;
}

/// int_delta^2 w(q) q / sqrt(q^2 - delta^2) dq: half the line integral of the 2D shape at distance delta.
double line_integral_2d(double delta) {
  if (delta > 1.8) return line_integral_2d_near_edge(delta);
  double sum = 0.0;
  for (Piece const& piece : pieces) {
    if (piece.to <= delta) continue;
    auto const upper = chord_moments(piece.to, delta);
    auto const lower = chord_moments(std::max(piece.from, delta), delta);
    for (int n = 0; n < 4; ++n) sum += piece.coefficient[n] * (upper[n] - lower[n]);
  }
  return sum;
}

/// int_delta^2 w(q) q acos(delta/q) dq: half the 2D shape's integral beyond a line at distance delta.
double beyond_line_2d(double delta) {
  double sum = 0.0;
  for (Piece const& piece : pieces) {
    if (piece.to <= delta) continue;
    double const from = std::max(piece.from, delta);
    auto const upper = chord_moments(piece.to, delta);
    auto const lower = chord_moments(from, delta);
    auto const angle = [delta](double q) {
      return q > delta ? std::atan2(std::sqrt((q - delta) * (q + delta)), delta) : 0.0;
    };
    double upper_power = piece.to * piece.to;
    double lower_power = from * from;
    for (int n = 0; n < 4; ++n) {
      sum += piece.coefficient[n] / (n + 2) *
             (upper_power * angle(piece.to) - lower_power * angle(from) - delta * (upper[n] - lower[n]));
      upper_power *= piece.to;
      lower_power *= from;
    }
  }
  return sum;
}

}  // namespace

template <int Dim>
double CubicSpline<Dim>::plane_integral(double d, double h) {
  double const delta = d / h;
  if (delta >= 2.0) return 0.0;
  if constexpr (Dim == 1) {
    return value(d, h);
  } else if constexpr (Dim == 2) {
    return 2.0 * sigma / h * line_integral_2d(delta);
  } else {
    double const p = 2.0 - delta;
    double const d2 = delta * delta;
    double const moment =
        delta < 1.0 ? 0.35 - d2 * (0.5 - d2 * (0.375 - 0.15 * delta)) : p * p * p * p * (0.125 - 0.05 * p);
    return 2.0 * std::numbers::pi * sigma / h * moment;
  }
}

template <int Dim>
double CubicSpline<Dim>::inner_fraction(double d, double h) {
  double const delta = d / h;
  if (delta >= 2.0) return 1.0;
  double const p = 2.0 - delta;
  double const d2 = delta * delta;
  if constexpr (Dim == 1) {
    return delta < 1.0 ? 0.5 + sigma * delta * (1.0 - d2 * (0.5 - 0.1875 * delta))
                       : 1.0 - sigma * p * p * p * p / 16.0;
  } else if constexpr (Dim == 2) {
    return 1.0 - 2.0 * sigma * beyond_line_2d(delta);
  } else {
    double const two_pi_sigma = 2.0 * std::numbers::pi * sigma;
    return delta < 1.0 ? 0.5 + two_pi_sigma * delta * (0.35 - d2 * (1.0 / 6.0 - d2 * (0.075 - 0.025 * delta)))
                       : 1.0 - two_pi_sigma * p * p * p * p * p * (0.025 - p / 120.0);
  }
}

template struct CubicSpline<1>;
template struct CubicSpline<2>;
template struct CubicSpline<3>;

}  // namespace sphverify
