// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/marshak.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

namespace {

constexpr std::size_t most_terms = 1000;
constexpr double negligible = 1e-19;  // relative to the first coefficient

/// Three in a row, since a coefficient that changes sign may be small by chance.
bool has_converged(std::vector<double> const& g) {
  if (g.size() < 5) return false;
  return std::all_of(g.end() - 3, g.end(), [&](double c) { return std::abs(c) < negligible * g[1]; });
}

std::vector<double> front_series(double n) {
  std::vector<double> g{0.0, 0.5 * n};
  while (!has_converged(g)) {
    if (g.size() > most_terms) {
      throw BadValue("exponent",
                     "0.001 or more, for the series about the front to converge in " +
                         std::to_string(most_terms) + " terms",
                     brief(n));
    }
    std::size_t const j = g.size() - 1;
    double const order = static_cast<double>(j);
    double sum = 0.5 * order * g[j];
    for (std::size_t i = 2; i <= j; ++i) {
      double const p = static_cast<double>(i);
      double const q = order + 2.0 - p;
      sum += (q * (q - 1.0) + p * q / n) * g[i] * g[j + 2 - i];
    }
    g.push_back(-2.0 * sum / ((order + 1.0) * (order * n + 1.0)));
  }
  return g;
}

}  // namespace

Marshak::Marshak(double exponent)
    : exponent_(require_positive("exponent", exponent)),
      coefficients_(front_series(exponent)),
      front_constant_(1.0 / std::sqrt(shape(1.0))) {}

/// s: 0 at the front, 1 at the wall, negative beyond the front. Expects t > 0.
double Marshak::depth(double x, double t) const { return 1.0 - x / (front_constant_ * std::sqrt(t)); }

/// g(s) by Horner's rule.
double Marshak::shape(double s) const {
  double sum = 0.0;
  for (std::size_t k = coefficients_.size(); k-- > 0;) sum = sum * s + coefficients_[k];
  return sum;
}

/// g'(s)
double Marshak::shape_slope(double s) const {
  double sum = 0.0;
  for (std::size_t k = coefficients_.size(); k-- > 1;)
    sum = sum * s + static_cast<double>(k) * coefficients_[k];
  return sum;
}

/// f'(0)
double Marshak::wall_slope() const { return -shape_slope(1.0) / (exponent_ * shape(1.0) * front_constant_); }

double Marshak::temperature(double x, double t) const {
  require_not_negative("time", t);
  if (t == 0.0) return x > 0.0 ? 0.0 : 1.0;
  double const s = depth(x, t);
  return s > 0.0 ? std::pow(shape(s) / shape(1.0), 1.0 / exponent_) : 0.0;
}

double Marshak::gradient(double x, double t) const {
  require_not_negative("time", t);
  if (t == 0.0) return x > 0.0 ? 0.0 : -std::numeric_limits<double>::infinity();
  double const s = depth(x, t);
  if (s <= 0.0) return 0.0;
  return -temperature(x, t) * shape_slope(s) / (exponent_ * shape(s) * front(t));
}

double Marshak::front(double t) const { return front_constant_ * std::sqrt(require_not_negative("time", t)); }

double Marshak::front_constant() const { return front_constant_; }

double Marshak::wall_flux(double t) const {
  return -wall_slope() / std::sqrt(require_not_negative("time", t));
}

double Marshak::total_energy(double t) const {
  return -2.0 * wall_slope() * std::sqrt(require_not_negative("time", t));
}

double Marshak::conductivity(double temperature) const {
  return std::pow(std::max(temperature, 0.0), exponent_);
}

double Marshak::accuracy() const { return 1e-12 * std::max(1.0, 1.0 / exponent_); }

}  // namespace sphverify::exact
