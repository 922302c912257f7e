// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace sphverify {

/// Which unknowns each rate depends on, in compressed rows; ascending within a row, the diagonal included.
struct DependencyPattern {
  std::vector<std::int64_t> first;
  std::vector<std::int64_t> column;

  std::size_t rows() const { return first.size() - 1; }
};

/// The sparse matrix d(rate)/dy by differences: columns that share no row are perturbed together, so that the
/// number of rate evaluations is the number of colours, not of unknowns (Curtis, Powell & Reid 1974). For an
/// affine rate the differences are exact to round-off, and computed once.
class ColouredJacobian {
 public:
  using Rate = std::function<void(double t, double const* y, double* dydt)>;

  /// @param affine whether the rate is affine in y with a matrix that does not depend on time
  /// @param scale size of a typical y, for the perturbation
  ColouredJacobian(DependencyPattern pattern, Rate rate, bool affine, double scale);

  DependencyPattern const& pattern() const { return pattern_; }
  std::size_t colours() const { return colours_; }

  /// Values in the order of the pattern.
  std::vector<double> const& evaluate(double t, double const* y);

  /// What a value is off, as a part of the largest of its row: rounding of a difference of two rates, each
  /// some times as large as the change; where a rate is not affine, the curvature over the root of the
  /// machine precision besides.
  double error() const;

  std::size_t bytes() const;

 private:
  void colour();

  DependencyPattern pattern_;
  Rate rate_;
  bool affine_;
  double scale_;
  bool known_ = false;
  std::size_t colours_ = 0;
  std::vector<std::uint32_t> colour_of_;
  std::vector<double> values_;
};

}  // namespace sphverify
