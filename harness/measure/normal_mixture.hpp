// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

namespace sphverify {

/// A weighted sum of normal distributions: what is known of a number under several hypotheses.
class NormalMixture {
 public:
  /// @param weight not negative; weights need not sum to 1
  /// @param deviation standard deviation; 0: the number is known
  void add(double weight, double mean, double deviation);
  /// Another mixture's components, all weights times a factor.
  void add(NormalMixture const& other, double factor);

  bool is_empty() const { return total_ <= 0.0; }
  double total_weight() const { return total_; }
  /// Probability of numbers up to x.
  double probability_below(double x) const;
  /// Where the probability below is p, between 0 and 1. Expects a mixture that is not empty.
  double quantile(double p) const { return quantiles({p}).front(); }
  std::vector<double> quantiles(std::vector<double> const& p) const;

 private:
  struct Component {
    double weight, mean, deviation;
  };
  /// The same in few components, which part by little from it.
  NormalMixture condensed() const;
  struct Range {
    double low, high;
    double tolerance() const;  ///< of a quantile
  };
  /// What holds all of it but next to nothing.
  Range range() const;
  double bracketed(double p) const;
  /// Newton's method from near a quantile; empty where it leads nowhere, as on steps.
  std::optional<double> polished(double p, double near, double tolerance) const;

  std::vector<Component> components_;
  double total_ = 0.0;
};

}  // namespace sphverify
