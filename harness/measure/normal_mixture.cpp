#include "harness/measure/normal_mixture.hpp"

#include <algorithm>
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
  double below = 0.0;
  for (Component const& c : components_) {
    double const distance = x - c.mean;
    if (std::abs(distance) >= reach * c.deviation) {
      if (distance >= 0.0) below += c.weight;
    } else {
      below += c.weight * 0.5 * std::erfc(-distance / (std::numbers::sqrt2 * c.deviation));
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
  constexpr double per_root_two_pi = 0.5 * std::numbers::sqrt2 * std::numbers::inv_sqrtpi;
  double x = near;
  for (int tries = 0; tries < 8; ++tries) {
    double density = 0.0;
    for (Component const& c : components_) {
      double const z = (x - c.mean) / c.deviation;
      if (std::abs(z) < reach) density += c.weight * per_root_two_pi / c.deviation * std::exp(-0.5 * z * z);
    }
    double const step = (p - probability_below(x)) * total_ / density;
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
