// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

namespace sphverify {

struct LevelError;

/// What is thought of the standard deviation of log(error) about its law, on a grid: uniform in its logarithm
/// from 1e-5 to 2; with replicates, what their scatter says of their mean, alone or with such a part on top
/// that all replicates of a level share.
class Scatter {
 public:
  explicit Scatter(std::vector<LevelError> const& levels);
  std::vector<double> const& log_sigma() const { return log_sigma_; }
  std::vector<double> const& log_weight() const { return log_weight_; }

 private:
  std::vector<double> log_sigma_, log_weight_;
};

/// The integral over the scatter sigma of sigma^-degrees exp(-rss / (2 sigma^2)), as a logarithm.
class ScatterMarginal {
 public:
  ScatterMarginal(Scatter const& scatter, double degrees);
  /// @param rss weighted sum of squares of what a law leaves of log(error)
  double operator()(double rss) const;
  /// Values of sigma with their parts of the integral; what is less than 0.002 of it is left out.
  std::vector<std::pair<double, double>> parts(double rss) const;

 private:
  double exactly(double rss) const;
  Scatter const& scatter_;
  double degrees_;
  double lowest_, step_;
  std::vector<double> table_;  ///< over log(rss)
};

}  // namespace sphverify
