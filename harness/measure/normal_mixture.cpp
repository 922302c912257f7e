#include "harness/measure/normal_mixture.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "formulations/support/expects.hpp"

namespace sphverify {

namespace {

constexpr double reach = 6.0;  // beyond which a normal distribution holds less than 1e-9

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
      below += c.weight * gsl_cdf_ugaussian_P(distance / c.deviation);
    }
  }
  return below / total_;
}

double NormalMixture::quantile(double p) const {
  expects(!is_empty());
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (Component const& c : components_) {
    low = std::min(low, c.mean - reach * c.deviation);
    high = std::max(high, c.mean + reach * c.deviation);
  }
  double const tolerance = 1e-7 + 1e-12 * std::max(std::abs(low), std::abs(high));
  if (high - low <= tolerance) return 0.5 * (low + high);
  std::uintmax_t most = 60;
  auto const [from, to] = boost::math::tools::toms748_solve(
      [&](double x) { return probability_below(x) - p; }, low - tolerance, high + tolerance,
      [tolerance](double a, double b) { return b - a <= tolerance; }, most);
  return 0.5 * (from + to);
}

}  // namespace sphverify
