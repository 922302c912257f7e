// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/error_law.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "harness/measure/adapted_cells.hpp"
#include "harness/measure/scatter.hpp"

namespace sphverify {

namespace {

// What is thought of the laws before the levels are seen. Orders are uniform over `orders`, the next term's
// logarithm at the coarsest level is Cauchy's with `next_scale`, the floor's odds at the finest level are
// uniform in their logarithm.
// With p near 0 a next term is a floor under another name: F + A d is F (1 + c d).
constexpr double lowest_order = -3.0, highest_order = 8.0;
constexpr double lowest_order_on_a_floor = 0.05, lowest_order_of_next_term = 0.2;
constexpr double next_scale = 0.2, next_limit = 3.0;
constexpr double alternation_scale = 0.3, alternation_limit = 4.0;
constexpr double lowest_log_odds = -7.0, highest_log_odds = 17.0;
constexpr double negligible = 1e-4;  // part of a law

double prior(LawKind kind) {
  switch (kind) {
    case LawKind::power:
      return 0.1;
    case LawKind::next_first:
      return 0.4;
    case LawKind::next_second:
      return 0.15;
    case LawKind::floor:
      return 0.3;
    case LawKind::alternation:
      return 0.05;
  }
  return 0.0;
}

/// The levels as the fits see them.
struct Points {
  std::vector<double> x, y, w;  ///< log(d / finest d), log(error), weight with mean 1
  double weight = 0.0;

  explicit Points(std::vector<LevelError> const& levels) {
    double replicates = 0.0;
    for (LevelError const& level : levels) replicates += level.replicates;
    for (LevelError const& level : levels) {
      x.push_back(std::log(level.spacing / levels.back().spacing));
      y.push_back(std::log(level.error));
      w.push_back(level.replicates * static_cast<double>(levels.size()) / replicates);
      weight += w.back();
    }
  }
  std::size_t size() const { return x.size(); }
};

/// A law's best fit at one value of its shape: log(error) = intercept + shape's part + slope x, or near
/// enough.
struct Fit {
  double intercept,
      slope;           ///< log A and p; with a floor the logarithm of the error at the finest level, and p
  double rss;          ///< weighted sum of squares of what is left
  double information;  ///< the order's variance is sigma^2 over this
};

/// One family of laws: how it is fitted at a value of its shape, and what that means.
struct Family {
  LawKind kind;
  double lowest_order;
  std::vector<double> shape_range;  ///< of u, in which the prior is uniform; empty: no shape
  std::function<Fit(double u)> fit;
  std::function<double(double u, Fit const&)> local_order;  ///< at the finest level
  std::function<ErrorLaw(double u, Fit const&)> law;
  std::function<double(double u)> floor_share;  ///< of the error at the finest level; empty without a floor
};

/// Weighted least squares of y - known(i) by a + p x.
class LineFit {
 public:
  explicit LineFit(Points const& points) : points_(points) {
    for (std::size_t i = 0; i < points.size(); ++i) mean_x_ += points.w[i] * points.x[i] / points.weight;
    for (std::size_t i = 0; i < points.size(); ++i)
      sum_xx_ += points.w[i] * (points.x[i] - mean_x_) * (points.x[i] - mean_x_);
  }

  template <class Known>
  Fit operator()(Known const& known) const {
    double mean_y = 0.0, sum_xy = 0.0, sum_yy = 0.0;
    std::vector<double> rest(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      rest[i] = points_.y[i] - known(i);
      mean_y += points_.w[i] * rest[i] / points_.weight;
    }
    for (std::size_t i = 0; i < points_.size(); ++i) {
      sum_xy += points_.w[i] * (points_.x[i] - mean_x_) * (rest[i] - mean_y);
      sum_yy += points_.w[i] * (rest[i] - mean_y) * (rest[i] - mean_y);
    }
    double const slope = sum_xy / sum_xx_;
    return {mean_y - slope * mean_x_, slope, std::max(0.0, sum_yy - slope * sum_xy), sum_xx_};
  }

 private:
  Points const& points_;
  double mean_x_ = 0.0, sum_xx_ = 0.0;
};

Family power_law(Points const& points) {
  return {LawKind::power,
          lowest_order,
          {},
          [line = LineFit(points)](double) { return line([](std::size_t) { return 0.0; }); },
          [](double, Fit const& fit) { return fit.slope; },
          [](double, Fit const& fit) {
            return ErrorLaw{0.0, std::exp(fit.intercept), fit.slope, 0.0, 1.0};
          },
          {}};
}

/// scale tan(u) is log(1 + c d^q) at the coarsest level: uniform in u, it is Cauchy's distribution.
Family next_term(Points const& points, LawKind kind, double q) {
  double const end = std::atan(next_limit / next_scale);
  double const coarsest = std::exp(q * points.x.front());
  auto const c = [coarsest](double u) { return std::expm1(next_scale * std::tan(u)) / coarsest; };
  return {kind,
          lowest_order_of_next_term,
          {-end, end},
          [line = LineFit(points), &points, c, q](double u) {
            return line([&](std::size_t i) { return std::log1p(c(u) * std::exp(q * points.x[i])); });
          },
          [c, q](double u, Fit const& fit) { return fit.slope + q * c(u) / (1.0 + c(u)); },
          [c, q](double u, Fit const& fit) {
            return ErrorLaw{0.0, std::exp(fit.intercept), fit.slope, c(u), q};
          },
          {}};
}

Family alternation(Points const& points) {
  double const end = std::atan(alternation_limit / alternation_scale);
  return {LawKind::alternation,
          lowest_order,
          {-end, end},
          [line = LineFit(points)](double u) {
            double const b = alternation_scale * std::tan(u);
            return line([b](std::size_t i) { return i % 2 == 0 ? b : -b; });
          },
          [](double, Fit const& fit) { return fit.slope; },
          [](double, Fit const& fit) {
            return ErrorLaw{0.0, std::exp(fit.intercept), fit.slope, 0.0, 1.0};
          },
          {}};
}

/// u is the logarithm of the floor's odds at the finest level, F over the rest of the error.
Family floor_law(Points const& points) {
  auto const share = [](double u) { return 1.0 / (1.0 + std::exp(-u)); };
  auto const rest = [](double u) { return 1.0 / (1.0 + std::exp(u)); };
  auto const at_order = [&points, share, rest](double u, double p) {
    double mean = 0.0, squares = 0.0, slope = 0.0, slopes = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      double const falling = rest(u) * std::exp(p * points.x[i]);
      double const whole = share(u) + falling;
      double const v = points.y[i] - std::log(whole);
      double const by_p = points.x[i] * falling / whole;
      mean += points.w[i] * v;
      squares += points.w[i] * v * v;
      slope += points.w[i] * by_p;
      slopes += points.w[i] * by_p * by_p;
    }
    mean /= points.weight;
    slope /= points.weight;
    return Fit{mean, p, std::max(0.0, squares - points.weight * mean * mean),
               std::max(0.0, slopes - points.weight * slope * slope)};
  };
  return {LawKind::floor,
          lowest_order_on_a_floor,
          {lowest_log_odds, highest_log_odds},
          [at_order](double u) {
            constexpr int bits = 20;
            double const p =
                boost::math::tools::brent_find_minima([&](double order) { return at_order(u, order).rss; },
                                                      lowest_order_on_a_floor, highest_order, bits)
                    .first;
            return at_order(u, p);
          },
          [rest](double u, Fit const& fit) { return fit.slope * rest(u); },
          [share, rest](double u, Fit const& fit) {
            double const error = std::exp(fit.intercept);
            return ErrorLaw{share(u) * error, rest(u) * error, fit.slope, 0.0, 1.0};
          },
          share};
}

/// Standard deviation of the order at one sigma; at most that of its prior.
double order_deviation(Family const& family, Fit const& fit, double sigma) {
  double const widest = (highest_order - family.lowest_order) / std::sqrt(12.0);
  return fit.information > 0.0 ? std::min(widest, sigma / std::sqrt(fit.information)) : widest;
}

/// Integrals over the scatter. Of the likelihood's sigma^-n the integral over the amplitude takes one power,
/// and that over the order, where the levels tell it, another.
struct Marginals {
  ScatterMarginal order_told, order_not_told;
};

LawEvidence weigh(Family const& family, Points const& points, Marginals const& marginals,
                  double& log_evidence) {
  auto const& [order_told, order_not_told] = marginals;
  LawEvidence evidence;
  evidence.kind = family.kind;
  double const n = static_cast<double>(points.size());
  double const range = highest_order - family.lowest_order;
  struct Member {
    double u, width, log_weight;
    Fit fit;
  };
  std::vector<Member> members;
  auto const log_weight = [&](Fit const& fit) {
    if (fit.slope < family.lowest_order) return -std::numeric_limits<double>::infinity();
    // Where the levels hardly tell the order, its prior is all there is.
    double const prior_alone = order_not_told(fit.rss);
    if (!(fit.information > 0.0)) return prior_alone;
    return std::min(
        prior_alone,
        order_told(fit.rss) + 0.5 * std::log(2.0 * std::numbers::pi / fit.information) - std::log(range));
  };
  if (family.shape_range.empty()) {
    Fit const only = family.fit(0.0);
    members.push_back({0.0, 0.0, log_weight(only), only});
  } else {
    double const low = family.shape_range.front(), high = family.shape_range.back();
    for (auto const& cell : adapted_cells(low, high, [&](double u) { return log_weight(family.fit(u)); }))
      members.push_back(
          {cell.centre, cell.width, cell.log_mass - std::log(high - low), family.fit(cell.centre)});
  }
  double top = -std::numeric_limits<double>::infinity();
  Member const* best = &members.front();
  for (Member const& m : members) {
    top = std::max(top, m.log_weight);
    if (m.fit.rss < best->fit.rss) best = &m;
  }
  if (!std::isfinite(top)) {  // no member of the family has an order that it may have
    log_evidence = top;
    return evidence;
  }
  double total = 0.0;
  for (Member const& m : members) total += std::exp(m.log_weight - top);
  log_evidence = top + std::log(total);
  evidence.best = family.law(best->u, best->fit);
  double const parameters = family.shape_range.empty() ? 2.0 : 3.0;
  evidence.scatter = std::sqrt(best->fit.rss / std::max(1.0, n - parameters));
  for (Member const& m : members) {
    double const share = std::exp(m.log_weight - top) / total;
    if (share < negligible) continue;
    double const local = family.local_order(m.u, m.fit);
    for (auto const& [sigma, part] : order_told.parts(m.fit.rss)) {
      double const deviation = order_deviation(family, m.fit, sigma);
      evidence.order.add(share * part, m.fit.slope, deviation);
      if (!family.floor_share) {
        evidence.local_order.add(share * part, local, deviation);
        continue;
      }
      double const floor_share = family.floor_share(m.u);
      evidence.local_order.add(share * part, local, (1.0 - floor_share) * deviation);
      evidence.log_floor.add(share * part, std::log(floor_share) + m.fit.intercept,
                             sigma / std::sqrt(points.weight));
    }
    if (family.floor_share) evidence.floor_share.add(share, family.floor_share(m.u), 0.0);
  }
  return evidence;
}

Family family_of(LawKind kind, Points const& points) {
  switch (kind) {
    case LawKind::next_first:
      return next_term(points, kind, 1.0);
    case LawKind::next_second:
      return next_term(points, kind, 2.0);
    case LawKind::floor:
      return floor_law(points);
    case LawKind::alternation:
      return alternation(points);
    default:
      return power_law(points);
  }
}

}  // namespace

std::string_view name_of(LawKind kind) {
  switch (kind) {
    case LawKind::power:
      return "power";
    case LawKind::next_first:
    case LawKind::next_second:
      return "power with a next term";
    case LawKind::floor:
      return "power on a floor";
    case LawKind::alternation:
      return "alternating power";
  }
  return "";
}

std::vector<LawEvidence> weigh_laws(std::vector<LevelError> const& levels) {
  Points const points(levels);
  Scatter const scatter(levels);
  double const n = static_cast<double>(levels.size());
  Marginals const marginals{{scatter, n - 2.0}, {scatter, n - 1.0}};
  std::vector<LawEvidence> all;
  std::vector<double> log_evidence;
  for (LawKind const kind : law_kinds) {
    // Of three levels each is the next one but one of another's at the most.
    if (kind == LawKind::alternation && levels.size() < 4) continue;
    double log_value = 0.0;
    all.push_back(weigh(family_of(kind, points), points, marginals, log_value));
    log_evidence.push_back(log_value + std::log(prior(kind)));
  }
  double const top = *std::max_element(log_evidence.begin(), log_evidence.end());
  double total = 0.0;
  for (double const v : log_evidence) total += std::exp(v - top);
  for (std::size_t k = 0; k < all.size(); ++k) all[k].probability = std::exp(log_evidence[k] - top) / total;
  return all;
}

}  // namespace sphverify
