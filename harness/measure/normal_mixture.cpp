// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/normal_mixture.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "formulations/basics/expects.hpp"

namespace sphverify {

namespace {

constexpr double reach = 6.0;  // beyond which a normal distribution holds less than 1e-9
constexpr std::size_t few_components = 48;

/// The standard normal distribution within reach, by cubics between a table's values and slopes: off by less than
/// h^4/384 times its largest fourth derivative, 4e-13. Mixtures of thousands ask for it thousands of times.
class NormalTable {
 public:
  struct Value {
    double below, density;
  };

  NormalTable() {
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      double const z = static_cast<double>(k) / per_unit - reach;
      double const density = 0.5 * std::numbers::sqrt2 * std::numbers::inv_sqrtpi * std::exp(-0.5 * z * z);
      nodes_[k] = {0.5 * std::erfc(-z / std::numbers::sqrt2), density / per_unit};
    }
  }

  /// Expects |z| <= reach.
  Value at(double z) const {
    double const place = (z + reach) * per_unit;
    auto const k = static_cast<std::size_t>(place);
    double const t = place - static_cast<double>(k);
    Node const& a = nodes_[k];
    Node const& b = nodes_[k + 1];
    double const rise = b.below - a.below;
    double const square = 3.0 * rise - 2.0 * a.slope - b.slope;
    double const cube = a.slope + b.slope - 2.0 * rise;
    return {a.below + t * (a.slope + t * (square + t * cube)), (a.slope + t * (2.0 * square + 3.0 * t * cube)) * per_unit};
  }

 private:
  static constexpr double per_unit = 256.0;
  struct Node {
    double below, slope;  ///< slope from one node to the next
  };
  std::array<Node, static_cast<std::size_t>(2.0 * reach * per_unit) + 2> nodes_;
};

NormalTable const& normal() {
  static NormalTable const table;
  return table;
}

}  // namespace

void NormalMixture::add(double weight, double mean, double deviation) {
  if (!(weight > 0.0)) return;
  components_.push_back({weight, mean, deviation});
  total_ += weight;
}

void NormalMixture::add(NormalMixture const& other, double factor) {
  for (Component const& c : other.components_) add(factor * c.weight, c.mean, c.deviation);
}

double NormalMixture::probability_below(double x) const {
  NormalTable const& table = normal();
  double below = 0.0;
  for (Component const& c : components_) {
    double const distance = x - c.mean;
    if (std::abs(distance) >= reach * c.deviation) {
      if (distance >= 0.0) below += c.weight;
    } else {
      below += c.weight * table.at(distance / c.deviation).below;
    }
  }
  return below / total_;
}

NormalMixture NormalMixture::condensed() const {
  std::vector<Component> sorted = components_;
  std::sort(sorted.begin(), sorted.end(),
            [](Component const& a, Component const& b) { return a.mean < b.mean; });
  NormalMixture few;
  double weight = 0.0, first = 0.0, second = 0.0;  // moments of those gathered, about 0
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    Component const& c = sorted[k];
    weight += c.weight;
    first += c.weight * c.mean;
    second += c.weight * (c.mean * c.mean + c.deviation * c.deviation);
    if (weight * few_components < total_ && k + 1 < sorted.size()) continue;
    double const mean = first / weight;
    few.add(weight, mean, std::sqrt(std::max(0.0, second / weight - mean * mean)));
    weight = first = second = 0.0;
  }
  return few;
}

std::optional<double> NormalMixture::polished(double p, double near, double tolerance) const {
  NormalTable const& table = normal();
  double x = near;
  for (int tries = 0; tries < 8; ++tries) {
    double below = 0.0, density = 0.0;
    for (Component const& c : components_) {
      double const distance = x - c.mean;
      if (std::abs(distance) >= reach * c.deviation) {
        if (distance >= 0.0) below += c.weight;
        continue;
      }
      auto const part = table.at(distance / c.deviation);
      below += c.weight * part.below;
      density += c.weight * part.density / c.deviation;
    }
    double const step = (p * total_ - below) / density;
    if (!std::isfinite(step)) return std::nullopt;
    x += step;
    if (std::abs(step) > tolerance) continue;
    // Where the density has a needle a short step says little.
    if (probability_below(x - tolerance) <= p && p <= probability_below(x + tolerance)) return x;
    return std::nullopt;
  }
  return std::nullopt;
}

double NormalMixture::Range::tolerance() const {
  return 1e-7 + 1e-12 * std::max(std::abs(low), std::abs(high));
}

NormalMixture::Range NormalMixture::range() const {
  double const infinity = std::numeric_limits<double>::infinity();
  Range range{infinity, -infinity};
  for (Component const& c : components_) {
    range.low = std::min(range.low, c.mean - reach * c.deviation);
    range.high = std::max(range.high, c.mean + reach * c.deviation);
  }
  return range;
}

double NormalMixture::bracketed(double p) const {
  Range const within = range();
  double const tolerance = within.tolerance();
  std::uintmax_t most = 60;
  auto const [from, to] = boost::math::tools::toms748_solve(
      [&](double x) { return probability_below(x) - p; }, within.low - tolerance, within.high + tolerance,
      [tolerance](double a, double b) { return b - a <= tolerance; }, most);
  return 0.5 * (from + to);
}

std::vector<double> NormalMixture::quantiles(std::vector<double> const& p) const {
  expects(!is_empty());
  Range const within = range();
  if (within.high - within.low <= within.tolerance())
    return std::vector<double>(p.size(), 0.5 * (within.low + within.high));
  // It is the sum over all components that costs: few of them say where to begin.
  std::optional<NormalMixture> few;
  if (components_.size() > 4 * few_components) few = condensed();
  std::vector<double> found;
  for (double const each : p) {
    std::optional<double> at;
    if (few) at = polished(each, few->bracketed(each), within.tolerance());
    found.push_back(at ? *at : bracketed(each));
  }
  return found;
}

}  // namespace sphverify
