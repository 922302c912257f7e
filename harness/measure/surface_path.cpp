// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/surface_path.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_matrix.h>
#include <gsl/gsl_multifit.h>
#include <gsl/gsl_vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>

#include "harness/measure/surface_law.hpp"

namespace sphverify {

namespace {

constexpr int continuous_ratios = 41;
constexpr int path_places = 33;
constexpr double beyond = 100.0;  ///< in cost, past either end of the range
constexpr int search_steps = 16;
constexpr int halvings = 14;

/// The abscissa of the least value of a parabola through three points of equal distance, in that distance
/// from the middle one.
double lowest_of_three(double left, double middle, double right) {
  double const bend = left - 2.0 * middle + right;
  return bend > 0.0 ? std::clamp(0.5 * (left - right) / bend, -1.0, 1.0) : 0.0;
}

}  // namespace

double surface_cost(CostLaw const& cost, double resolution, double ratio) {
  return cost.coefficient * std::pow(resolution, cost.resolution_exponent) *
         std::pow(ratio, cost.ratio_exponent);
}

SurfaceWalk::SurfaceWalk(SurfaceLaw const& law, SurfaceRange const& range)
    : law_(law), range_(range), continuous_(law.sampling.empty()) {
  if (continuous_) {
    for (int k = 0; k < continuous_ratios; ++k) {
      ratios_.push_back(range.lowest * std::pow(range.highest / range.lowest, k / (continuous_ratios - 1.0)));
    }
  } else {
    for (SamplingAtRatio const& s : law.sampling) ratios_.push_back(s.ratio);
  }
}

double SurfaceWalk::error(double resolution, double ratio) const {
  return surface_error(law_, range_.finest_spacing * range_.finest / resolution, ratio);
}

template <typename ErrorOf>
SurfacePlace SurfaceWalk::least(ErrorOf const& error_of) const {
  std::vector<double> errors;
  for (double const ratio : ratios_) errors.push_back(error_of(ratio));
  auto const found = std::min_element(errors.begin(), errors.end());
  auto const k = static_cast<std::size_t>(found - errors.begin());
  SurfacePlace place;
  place.ratio = ratios_[k];
  place.error = *found;
  if (k == 0) place.edge = "lower";
  if (k + 1 == ratios_.size()) place.edge = "upper";
  if (continuous_ && place.edge.empty()) {
    double const step = std::log(ratios_[k + 1] / ratios_[k]);
    place.ratio *= std::exp(
        step * lowest_of_three(std::log(errors[k - 1]), std::log(errors[k]), std::log(errors[k + 1])));
    place.error = error_of(place.ratio);
  }
  return place;
}

SurfacePlace SurfaceWalk::best(double resolution) const {
  SurfacePlace place = least([&](double ratio) { return error(resolution, ratio); });
  place.resolution = resolution;
  return place;
}

SurfacePlace SurfaceWalk::best_for(double cost_spent, CostLaw const& cost) const {
  auto const resolution_at = [&](double ratio) {
    return std::pow(cost_spent / surface_cost(cost, 1.0, ratio), 1.0 / cost.resolution_exponent);
  };
  SurfacePlace place = least([&](double ratio) { return error(resolution_at(ratio), ratio); });
  place.resolution = resolution_at(place.ratio);
  place.cost = cost_spent;
  return place;
}

std::optional<SurfacePlace> SurfaceWalk::cheapest(double error, CostLaw const& cost) const {
  double low = surface_cost(cost, range_.coarsest, range_.lowest) / beyond;
  double const last = surface_cost(cost, range_.finest, range_.highest) * beyond;
  if (best_for(low, cost).error <= error) return std::nullopt;
  // Spending more need not buy less error all the way: the first place that has it counts.
  double const step = std::pow(last / low, 1.0 / search_steps);
  double high = low * step;
  for (int k = 0; best_for(high, cost).error > error; ++k) {
    if (k == search_steps) return std::nullopt;
    low = high;
    high *= step;
  }
  for (int halving = 0; halving < halvings; ++halving) {
    double const between = std::sqrt(low * high);
    (best_for(between, cost).error <= error ? high : low) = between;
  }
  return best_for(high, cost);
}

std::vector<SurfacePlace> SurfaceWalk::path(CostLaw const& cost, std::size_t most) const {
  double const first = surface_cost(cost, range_.coarsest, best(range_.coarsest).ratio);
  double const last = surface_cost(cost, range_.finest, best(range_.finest).ratio);
  std::vector<SurfacePlace> places;
  for (int k = 0; k < path_places && places.size() < most; ++k) {
    SurfacePlace const place = best_for(first * std::pow(last / first, k / (path_places - 1.0)), cost);
    constexpr double rounding = 1.0 + 1e-9;
    if (place.resolution * rounding < range_.coarsest || place.resolution > range_.finest * rounding)
      continue;
    // To spend more and get nothing for it is no way down.
    if (!places.empty() && place.error >= places.back().error) continue;
    places.push_back(place);
  }
  return places;
}

std::optional<double> neighbour_exponent(std::vector<SurfacePlace> const& places) {
  std::set<double> resolutions;
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  double const n = static_cast<double>(places.size());
  for (SurfacePlace const& place : places) {
    resolutions.insert(place.resolution);
    x += std::log(place.resolution) / n;
    y += std::log(place.ratio) / n;
  }
  if (resolutions.size() < 3) return std::nullopt;
  for (SurfacePlace const& place : places) {
    double const from_mean = std::log(place.resolution) - x;
    xx += from_mean * from_mean;
    xy += from_mean * (std::log(place.ratio) - y);
  }
  return xy / xx;
}

PathRule follow_rule(double exponent, SurfaceWalk const& walk, SurfacePlace const& start, CostLaw const& cost,
                     SurfaceRange const& range) {
  PathRule rule;
  rule.exponent = exponent;
  double const room = std::log((exponent > 0.0 ? range.highest : range.lowest) / start.ratio);
  rule.resolution = range.finest;
  if (exponent != 0.0) rule.resolution = std::min(range.finest, start.resolution * std::exp(room / exponent));
  rule.ratio = start.ratio * std::pow(rule.resolution / start.resolution, exponent);
  rule.error = walk.error(rule.resolution, rule.ratio);
  double const spent = surface_cost(cost, rule.resolution, rule.ratio);
  SurfacePlace const same_cost = walk.best_for(spent, cost);
  rule.error_ratio.value = rule.error / same_cost.error;
  if (auto const same_error = walk.cheapest(rule.error, cost))
    rule.cost_ratio.value = spent / same_error->cost;
  constexpr double well_beyond = 1.1;
  if (rule.resolution < range.finest)
    rule.remark = "h/dx reaches the grid's end there";
  else if (same_cost.resolution > well_beyond * range.finest)
    rule.remark = "the best path is followed beyond the finest resolution";
  if (!rule.cost_ratio.value) rule.remark = "no such error on the best path";
  return rule;
}

std::optional<CostLaw> fit_cost(std::string const& unit, std::vector<CostDatum> const& data) {
  std::set<double> resolutions, ratios;
  for (CostDatum const& datum : data) {
    if (!(datum.cost > 0.0)) return std::nullopt;
    resolutions.insert(datum.resolution);
    ratios.insert(datum.ratio);
  }
  if (data.size() < 4 || resolutions.size() < 2 || ratios.size() < 2) return std::nullopt;
  auto const vector = [](std::size_t n) {
    return std::unique_ptr<gsl_vector, decltype(&gsl_vector_free)>(gsl_vector_alloc(n), &gsl_vector_free);
  };
  auto const matrix = [](std::size_t n, std::size_t k) {
    return std::unique_ptr<gsl_matrix, decltype(&gsl_matrix_free)>(gsl_matrix_alloc(n, k), &gsl_matrix_free);
  };
  std::size_t const n = data.size();
  auto const x = matrix(n, 3);
  auto const covariance = matrix(3, 3);
  auto const y = vector(n);
  auto const c = vector(3);
  for (std::size_t k = 0; k < n; ++k) {
    gsl_matrix_set(x.get(), k, 0, 1.0);
    gsl_matrix_set(x.get(), k, 1, std::log(data[k].resolution));
    gsl_matrix_set(x.get(), k, 2, std::log(data[k].ratio));
    gsl_vector_set(y.get(), k, std::log(data[k].cost));
  }
  std::unique_ptr<gsl_multifit_linear_workspace, decltype(&gsl_multifit_linear_free)> const workspace(
      gsl_multifit_linear_alloc(n, 3), &gsl_multifit_linear_free);
  double sum = 0.0;
  if (gsl_multifit_linear(x.get(), y.get(), c.get(), covariance.get(), &sum, workspace.get()) != GSL_SUCCESS)
    return std::nullopt;
  CostLaw const law{unit, std::exp(gsl_vector_get(c.get(), 0)), gsl_vector_get(c.get(), 1),
                    gsl_vector_get(c.get(), 2), std::sqrt(sum / static_cast<double>(n))};
  // A cost that does not rise with the resolution is no cost of one.
  return law.resolution_exponent > 0.0 ? std::optional(law) : std::nullopt;
}

}  // namespace sphverify
