#include "harness/measure/order.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sphverify {

std::string_view const verdict_rules =
    R"(order      slope of log(mean error) over log(spacing), least squares on the true spacings
interval   95%, Student's t on the fit's residuals; with several seeds also from their spread: the
           wider one is given. Two levels give an order without an interval.
left out   levels whose error is at the run's `round_off`: they say nothing of the order
not-refined    fewer than three spacings, a finest level that ran out of time, or an error that does
               not change at all (below 1 part in 1e6)
asymptotic     the interval excludes 0, the last two pairwise orders agree within 0.3, and the
               last is at least 0.8 of their mean (it fades on the way to a floor); with orders
               of 0.1 to 0.25: pre-asymptotic
diverging      a run of the finest level broke, or the last step raised the error (pairwise
               order < -0.25) in a ladder whose fitted order is not positive
floored        the last step changed the error little (pairwise order between -0.25 and 0.25)
               after steps that changed it as little or, one by one, less and less; or the error
               reached round-off
pre-asymptotic anything else
at a jump      the solution allows at most order 1 in l1 and 1/2 in l2 (`allowed`); linf cannot
               go down: floored)";

namespace {

constexpr double plateau_order = 0.25;
constexpr double slow_order = 0.1;
constexpr double agreement = 0.3;
constexpr double fading = 0.8;
constexpr double unchanged = 1e-6;

struct Point {
  double log_spacing;
  double log_error;
  double variance;  ///< of log_error, from the replicates; NaN where there are none
  std::size_t replicates;
};

double mean(std::vector<double> const& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Point point_of(LadderLevel const& level) {
  double const average = mean(level.errors);
  std::size_t const n = level.errors.size();
  double variance = std::numeric_limits<double>::quiet_NaN();
  if (n > 1) {
    double sum = 0.0;
    for (double const e : level.errors) sum += (e - average) * (e - average);
    // Of the mean, carried over to its logarithm.
    variance = sum / static_cast<double>(n - 1) / static_cast<double>(n) / (average * average);
  }
  return {std::log(level.spacing), std::log(average), variance, n};
}

double student_quantile(double degrees_of_freedom) { return gsl_cdf_tdist_Pinv(0.975, degrees_of_freedom); }

/// Half width of the slope's 95% interval from the replicates' spread; 0 where no level has replicates.
double spread_half_width(std::vector<Point> const& points, double mean_x, double sum_xx) {
  double variance = 0.0;
  double degrees = 0.0;
  for (Point const& p : points) {
    if (std::isnan(p.variance)) continue;
    double const weight = (p.log_spacing - mean_x) / sum_xx;
    variance += weight * weight * p.variance;
    degrees += static_cast<double>(p.replicates - 1);
  }
  return degrees > 0.0 ? student_quantile(degrees) * std::sqrt(variance) : 0.0;
}

void fit(std::vector<Point> const& points, ObservedOrder& observed) {
  std::vector<double> x, y;
  for (Point const& p : points) {
    x.push_back(p.log_spacing);
    y.push_back(p.log_error);
  }
  double intercept, slope, cov00, cov01, cov11, residual;
  gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &intercept, &slope, &cov00, &cov01, &cov11, &residual);
  observed.order = slope;
  if (points.size() < 3) return;
  double const mean_x = mean(x);
  double sum_xx = 0.0;
  for (double const value : x) sum_xx += (value - mean_x) * (value - mean_x);
  double const degrees = static_cast<double>(points.size() - 2);
  double const half_width =
      std::max(student_quantile(degrees) * std::sqrt(cov11), spread_half_width(points, mean_x, sum_xx));
  observed.lower = slope - half_width;
  observed.upper = slope + half_width;
}

/// Whether every step of refinement changed the error less than the one before, give or take the agreement of
/// orders.
bool orders_fade(std::vector<Number> const& pairwise) {
  for (std::size_t k = 1; k < pairwise.size(); ++k) {
    if (std::abs(*pairwise[k]) > std::abs(*pairwise[k - 1]) + agreement) return false;
  }
  return true;
}

/// Whether the ladder goes down at one pace: the interval excludes 0, the last two pairwise orders agree, and
/// the last is not much below their mean, as it would be on the way to a floor.
bool is_steady(ObservedOrder const& observed) {
  double sum = 0.0;
  for (Number const& p : observed.pairwise) sum += *p;
  double const mean_order = sum / static_cast<double>(observed.pairwise.size());
  double const last = *observed.pairwise.back();
  double const before = *observed.pairwise[observed.pairwise.size() - 2];
  return observed.lower.value_or(0.0) > 0.0 && std::abs(last - before) <= agreement &&
         last >= fading * mean_order;
}

void judge(std::vector<LadderLevel> const& levels, std::vector<Point> const& points,
           ObservedOrder& observed) {
  auto const say = [&](char const* verdict, char const* reason) {
    observed.verdict = verdict;
    observed.reason = reason;
  };
  if (!levels.empty() && levels.back().errors.empty()) {
    if (levels.back().out_of_time) return say("not-refined", "the finest level ran out of time");
    return say("diverging", "the finest level has no error");
  }
  if (levels.size() < 3) return say("not-refined", "fewer than three spacings");
  bool const ends_at_round_off = mean(levels.back().errors) <= levels.back().round_off;
  if (ends_at_round_off) return say("floored", "the error reached round-off");
  if (points.size() < 3) return say("not-refined", "fewer than three levels have an error above round-off");
  auto const [low, high] = std::minmax_element(
      points.begin(), points.end(), [](Point const& a, Point const& b) { return a.log_error < b.log_error; });
  if (high->log_error - low->log_error < unchanged)
    return say("not-refined", "refinement changes nothing at all");
  double const last = observed.pairwise.back().value();
  double const before = observed.pairwise[observed.pairwise.size() - 2].value();
  if (is_steady(observed) && last >= slow_order) {
    if (last >= plateau_order) return say("asymptotic", "the last pairwise orders agree and do not fade");
    return say("pre-asymptotic", "the error goes down steadily, but slowly: order 0.1 to 0.25");
  }
  if (last < -plateau_order && *observed.order <= 0.0)
    return say("diverging", "the last refinement raised the error");
  if (std::abs(last) < plateau_order &&
      (std::abs(before) < plateau_order || orders_fade(observed.pairwise))) {
    return say("floored", "the last refinement changed the error little");
  }
  return say("pre-asymptotic", "the pairwise orders still change or fade, or the interval includes 0");
}

}  // namespace

ObservedOrder observed_order(std::vector<LadderLevel> const& levels) {
  ObservedOrder observed;
  std::vector<Point> points;
  for (LadderLevel const& level : levels) {
    if (level.errors.empty() || mean(level.errors) <= level.round_off) continue;
    points.push_back(point_of(level));
  }
  for (std::size_t k = 1; k < points.size(); ++k) {
    observed.pairwise.push_back((points[k].log_error - points[k - 1].log_error) /
                                (points[k].log_spacing - points[k - 1].log_spacing));
  }
  if (points.size() >= 2) fit(points, observed);
  judge(levels, points, observed);
  return observed;
}

}  // namespace sphverify
