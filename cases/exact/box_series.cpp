// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/box_series.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

namespace {

/// Whether a factor is a cosine.
bool is_cosine(BoxSides sides, int axis) { return sides == BoxSides::insulated && axis > 0; }

template <int Dim>
double wavenumber(BoxMode<Dim> const& mode, int axis) {
  return mode.numbers[static_cast<std::size_t>(axis)] * std::numbers::pi;
}

}  // namespace

template <int Dim>
BoxSeries<Dim>::BoxSeries(double left, double right, std::vector<BoxMode<Dim>> modes, BoxSides sides,
                          double conductivity, double density)
    : left_(require_finite("left", left)),
      right_(require_finite("right", right)),
      modes_(std::move(modes)),
      sides_(sides),
      diffusivity_(require_positive("conductivity", conductivity) / require_positive("density", density)) {
  for (BoxMode<Dim> const& mode : modes_) {
    require_finite("mode amplitude", mode.amplitude);
    for (int k = 0; k < Dim; ++k) {
      int const number = mode.numbers[static_cast<std::size_t>(k)];
      if (is_cosine(sides, k)) {
        require_not_negative("mode number along an insulated axis", number);
      } else {
        require_positive("mode number", number);
      }
    }
  }
}

template <int Dim>
double BoxSeries<Dim>::factor(BoxMode<Dim> const& mode, int axis, double coordinate) const {
  double const phase = wavenumber(mode, axis) * coordinate;
  return is_cosine(sides_, axis) ? std::cos(phase) : std::sin(phase);
}

template <int Dim>
double BoxSeries<Dim>::slope(BoxMode<Dim> const& mode, int axis, double coordinate) const {
  double const k = wavenumber(mode, axis);
  return is_cosine(sides_, axis) ? -k * std::sin(k * coordinate) : k * std::cos(k * coordinate);
}

template <int Dim>
double BoxSeries<Dim>::decay(BoxMode<Dim> const& mode, double t) const {
  double square = 0.0;
  for (int k = 0; k < Dim; ++k) square += wavenumber(mode, k) * wavenumber(mode, k);
  return std::exp(-square * diffusivity_ * t);
}

template <int Dim>
double BoxSeries<Dim>::temperature(Vector<Dim> const& r, double t) const {
  require_not_negative("time", t);
  double sum = left_ + (right_ - left_) * r[0];
  for (BoxMode<Dim> const& mode : modes_) {
    double product = mode.amplitude * decay(mode, t);
    for (int k = 0; k < Dim; ++k) product *= factor(mode, k, r[k]);
    sum += product;
  }
  return sum;
}

template <int Dim>
Vector<Dim> BoxSeries<Dim>::gradient(Vector<Dim> const& r, double t) const {
  require_not_negative("time", t);
  Vector<Dim> sum = (right_ - left_) * Vector<Dim>::Unit(0);
  for (BoxMode<Dim> const& mode : modes_) {
    double const size = mode.amplitude * decay(mode, t);
    for (int along = 0; along < Dim; ++along) {
      double product = size;
      for (int k = 0; k < Dim; ++k) product *= k == along ? slope(mode, k, r[k]) : factor(mode, k, r[k]);
      sum[along] += product;
    }
  }
  return sum;
}

template <int Dim>
double BoxSeries<Dim>::accuracy() const {
  // Rounding: of the straight line; of each amplitude, its Dim factors and its decay, and of its phases n pi
  // r.
  double sum = std::abs(left_) + std::abs(right_);
  for (BoxMode<Dim> const& mode : modes_) {
    double phases = 0.0;
    for (int k = 0; k < Dim; ++k) phases += wavenumber(mode, k);
    sum += std::abs(mode.amplitude) * (1.0 + Dim + phases);
  }
  return 2.0 * std::numeric_limits<double>::epsilon() * sum;
}

template class BoxSeries<2>;
template class BoxSeries<3>;

}  // namespace sphverify::exact
