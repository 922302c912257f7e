// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "harness/measure/error_law.hpp"

namespace sphverify {

std::string_view const verdict_rules =
    R"(order      p of the laws A d^p, A d^p (1 + c d), A d^p (1 + c d^2), F + A d^p and A d^p with
           alternating levels: each counts by how well it explains the levels (Bayes' rule,
           docs/decisions/0009); null where they cannot tell it to 1 or to half of itself
interval   95%, of p, all laws that the levels do not refuse. Two levels give an order without one
floor      F with its interval, where the levels tell that there is one
targets    the N at which the likeliest law comes down to an error, or that it never does
left out   levels whose error is at the run's `round_off`, and those before the signed error passed
           through zero, if it did so once: they say nothing of the order
not-refined    fewer than three spacings, a finest level that ran out of time or whose command failed,
               or an error that does not change at all (below 1 part in 1e6)
floored        the error reached round-off; or most of the finest error is a floor, at 95%
               confidence; or the order at the finest level is surely below 1/4 (of what the
               solution allows, if that is less than 1) and above -1/4, unless it is known as
               well as an asymptotic one: then pre-asymptotic
diverging      a run of the finest level broke; or the order at the finest level is surely
               negative, and not within 1/4 of 0; or the finest error is by far the largest
asymptotic     at least four levels, an order known to 0.1 or a quarter of itself, which is what the
               finest levels show (within a fifth), is surely positive and not surely above
               what the solution allows, and no floor that holds half of the finest error
pre-asymptotic anything else; the reason says which
allowed        the highest order that the solution allows in this norm and region: docs/measures.md
time           where errors in time may be a tenth of these errors or more, the reason says so)";

namespace {

// Of the statements one by one, so that 95% of them hold in every family of ladders that was tried.
constexpr double confidence = 0.98;
constexpr double floor_confidence = 0.99;
constexpr double plateau_order = 0.25;
constexpr double known_absolutely = 0.1, known_relatively = 0.25;
constexpr double told_absolutely = 1.0, told_relatively = 0.5;
constexpr double settled = 0.2;
constexpr double sure = 0.95;
constexpr double not_refused = 0.05;  // probability of a law
constexpr double floor_told = 0.97;
constexpr double least_floor_share = 0.05;
constexpr double unchanged = 1e-6;
constexpr double far_largest = 1.5;
constexpr double signed_part = 0.3, least_signed_part = 0.1;
constexpr double above_allowed = 0.1;
constexpr double time_remark = 0.1;
constexpr std::size_t least_levels = 4, least_levels_alternating = 6;
constexpr double largest_scatter = 0.4;  // of log(error)
constexpr double chance_scatter = 3e-3;  // of log(error)
constexpr double farthest = 1e6;

double mean(std::vector<double> const& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

LevelError level_error(LadderLevel const& level) {
  double const average = mean(level.errors);
  double squares = 0.0;
  for (double const e : level.errors) squares += (e / average - 1.0) * (e / average - 1.0);
  return {level.spacing, average, static_cast<int>(level.errors.size()), squares};
}

/// The levels that say something of the order.
struct UsedLevels {
  std::vector<LadderLevel const*> above_round_off;
  std::size_t sign_changes = 0;  ///< of the mean error where it is a good part of the error on both sides
  std::size_t first = 0;         ///< of those above round-off, the first that is fitted
};

/// A passage of the signed error through zero makes its norm dip: levels before it are left out. An error
/// that changes its sign at every other step or more swings about its law, and counts as scatter.
UsedLevels used_levels(std::vector<LadderLevel> const& levels) {
  UsedLevels used;
  for (LadderLevel const& level : levels) {
    if (!level.errors.empty() && mean(level.errors) > level.round_off) used.above_round_off.push_back(&level);
  }
  auto const& all = used.above_round_off;
  auto const part = [](LadderLevel const& level) { return std::abs(*level.mean) / mean(level.errors); };
  std::size_t last = 0;
  for (std::size_t k = 1; k < all.size(); ++k) {
    if (!all[k]->mean || !all[k - 1]->mean || (*all[k]->mean < 0.0) == (*all[k - 1]->mean < 0.0)) continue;
    auto const [smaller, larger] = std::minmax({part(*all[k]), part(*all[k - 1])});
    if (larger < signed_part || smaller < least_signed_part) continue;
    ++used.sign_changes;
    last = k;
  }
  bool const swings = used.sign_changes > 1 && 2 * used.sign_changes >= all.size() - 1;
  if (!swings) used.first = last;
  return used;
}

/// What the laws say together.
struct Knowledge {
  NormalMixture order, local_order;
  LawEvidence const* likeliest = nullptr;
  LawEvidence const* floor = nullptr;

  explicit Knowledge(std::vector<LawEvidence> const& laws) {
    for (LawEvidence const& law : laws) {
      order.add(law.order, law.probability);
      local_order.add(law.local_order, law.probability);
      if (likeliest == nullptr || law.probability > likeliest->probability) likeliest = &law;
      if (law.kind == LawKind::floor) floor = &law;
    }
  }

  /// Probability that a floor holds more than a part of the finest error.
  double floor_holds(double part) const {
    return floor->probability * (1.0 - floor->floor_share.probability_below(part));
  }
};

struct Interval {
  double low, middle, high;
  explicit Interval(NormalMixture const& m, double part = confidence) {
    auto const at = m.quantiles({0.5 * (1.0 - part), 0.5, 0.5 * (1.0 + part)});
    low = at[0], middle = at[1], high = at[2];
  }
  double half_width() const { return 0.5 * (high - low); }
};

/// Whether every step goes the other way than the one before, and further than rounding.
bool goes_up_and_down(std::vector<LevelError> const& levels) {
  if (levels.size() < least_levels || levels.size() >= least_levels_alternating) return false;
  for (std::size_t k = 2; k < levels.size(); ++k) {
    double const step = std::log(levels[k].error / levels[k - 1].error);
    double const before = std::log(levels[k - 1].error / levels[k - 2].error);
    if (step * before >= 0.0 || std::min(std::abs(step), std::abs(before)) < largest_scatter) return false;
  }
  return true;
}

/// Of the order: what the laws say together, and at least what each law says alone that the levels do not
/// refuse.
Interval order_interval(std::vector<LawEvidence> const& laws, Knowledge const& known) {
  Interval interval(known.order);
  for (LawEvidence const& law : laws) {
    if (law.probability < not_refused) continue;
    auto const ends = law.order.quantiles({0.025, 0.975});
    interval.low = std::min(interval.low, ends[0]);
    interval.high = std::max(interval.high, ends[1]);
  }
  return interval;
}

struct Judgement {
  std::string verdict, reason;
};

/// Whether the levels know how far they scatter about a floor: with one level to spare and no replicates, a
/// law that goes through them may do so by chance.
bool knows_scatter(std::vector<LevelError> const& levels, Knowledge const& known) {
  bool const has_replicates =
      std::any_of(levels.begin(), levels.end(), [](LevelError const& level) { return level.replicates > 1; });
  return has_replicates || levels.size() > least_levels || known.floor->scatter < chance_scatter;
}

/// The verdict on levels that a law could be fitted to.
Judgement judge(std::vector<LevelError> const& levels, Knowledge const& known, Interval const& order,
                Interval const& local, Number const& allowed) {
  double const plateau = plateau_order * std::min(1.0, allowed.value_or(1.0));
  double largest_before = 0.0;
  for (std::size_t k = 0; k + 1 < levels.size(); ++k)
    largest_before = std::max(largest_before, levels[k].error);
  if (levels.back().error > far_largest * largest_before)
    return {"diverging", "the finest level has by far the largest error"};
  bool const alternates = known.likeliest->kind == LawKind::alternation;
  if (alternates && levels.size() < least_levels_alternating)
    return {"pre-asymptotic",
            "every other level is off by a factor: more levels, or other ratios of refinement"};
  if (goes_up_and_down(levels)) {
    return {"pre-asymptotic",
            "the error goes up and down from level to level: more levels, or other ratios of refinement"};
  }
  if (double const scatter = known.likeliest->scatter; scatter > largest_scatter)
    return {"pre-asymptotic",
            fmt::format("the levels scatter by a factor of {:.1f} about any law", std::exp(scatter))};
  bool const is_known = order.half_width() <= std::max(known_absolutely, known_relatively * order.middle);
  bool const may_be_floor = known.floor_holds(0.5) > 1.0 - sure;
  bool const is_settled = std::abs(local.middle - order.middle) <= settled * order.middle;
  if (order.low > 0.0 && is_known && is_settled && !may_be_floor && order.middle < plateau)
    return {"pre-asymptotic", "the error goes down steadily, but slowly"};
  if (known.floor_holds(0.5) >= sure && knows_scatter(levels, known))
    return {"floored", "most of what is left is a floor"};
  if (std::abs(local.low) < plateau && std::abs(local.high) < plateau)
    return {"floored", "refinement changes the error little"};
  if (local.high < 0.0) return {"diverging", "refinement raises the error"};
  if (order.low <= 0.0) return {"pre-asymptotic", "the levels do not tell the order from 0"};
  if (!is_known) {
    return {"pre-asymptotic", known.floor->probability > 0.5
                                  ? "on the way to a floor, of an order that is not known well yet"
                                  : "the order is not known well yet"};
  }
  if (may_be_floor) return {"pre-asymptotic", "half of what is left may be a floor"};
  if (!is_settled) {
    return {"pre-asymptotic",
            known.floor->probability > 0.5
                ? fmt::format("on the way to a floor: order {:.2g} at the finest level", local.middle)
                : fmt::format("the order still changes: {:.2g} at the finest level", local.middle)};
  }
  if (allowed && order.low > *allowed + above_allowed * std::max(1.0, *allowed)) {
    return {
        "pre-asymptotic",
        fmt::format("falls faster than the solution allows (order {:.2g}): this will not last", *allowed)};
  }
  if (levels.size() < least_levels) return {"pre-asymptotic", "three levels: a verdict needs four"};
  return {"asymptotic", alternates ? "both halves of the levels, taken in turn, follow one order"
                                   : "the levels follow one order"};
}

void describe(std::vector<LevelError> const& levels, Knowledge const& known, Interval const& order,
              ObservedOrder& observed) {
  bool const is_told =
      order.half_width() <= std::max(told_absolutely, told_relatively * std::abs(order.middle));
  if (is_told) {
    observed.order = order.middle;
    observed.lower = order.low;
    observed.upper = order.high;
  }
  observed.model = name_of(known.likeliest->kind);
  observed.law = known.likeliest->best;
  if (knows_scatter(levels, known) && known.floor->probability >= floor_told &&
      known.floor_holds(least_floor_share) >= floor_told) {
    Interval const floor(known.floor->log_floor, floor_confidence);
    observed.floor = ErrorFloor{std::exp(floor.middle), std::exp(floor.low), std::exp(floor.high)};
  }
}

}  // namespace

ObservedOrder observed_order(std::vector<LadderLevel> const& levels, LadderContext const& context) {
  ObservedOrder observed;
  auto const say = [&](std::string verdict, std::string reason) {
    observed.verdict = std::move(verdict);
    observed.reason = std::move(reason);
    return observed;
  };
  UsedLevels const selection = used_levels(levels);
  auto const& used = selection.above_round_off;
  for (std::size_t k = 1; k < used.size(); ++k) {
    observed.pairwise.push_back(std::log(mean(used[k]->errors) / mean(used[k - 1]->errors)) /
                                std::log(used[k]->spacing / used[k - 1]->spacing));
  }
  std::size_t const sign_change = selection.first;
  std::vector<LevelError> fitted;
  for (std::size_t k = sign_change; k < used.size(); ++k) fitted.push_back(level_error(*used[k]));
  bool const is_constant = [&] {
    auto const [low, high] =
        std::minmax_element(fitted.begin(), fitted.end(),
                            [](LevelError const& a, LevelError const& b) { return a.error < b.error; });
    return fitted.size() >= 2 && high->error <= low->error * (1.0 + unchanged);
  }();
  if (fitted.size() == 2 && sign_change == 0) observed.order = observed.pairwise.back();
  std::vector<LawEvidence> laws;
  std::optional<Knowledge> known;
  std::optional<Interval> order, local;
  if (fitted.size() >= 3 && !is_constant) {
    laws = weigh_laws(fitted);
    known.emplace(laws);
    order.emplace(order_interval(laws, *known));
    local.emplace(known->local_order);
    describe(fitted, *known, *order, observed);
  }

  if (!levels.empty() && levels.back().errors.empty()) {
    if (levels.back().out_of_time) return say("not-refined", "the finest level ran out of time, or its command failed");
    return say("diverging", "the finest level has no error");
  }
  if (levels.size() < 3) return say("not-refined", "fewer than three spacings");
  if (mean(levels.back().errors) <= levels.back().round_off)
    return say("floored", "the error reached round-off");
  std::string const crossing =
      sign_change == 0 ? ""
                       : fmt::format("the signed error passes through zero between levels {} and {}",
                                     sign_change, sign_change + 1);
  if (fitted.size() < 3) {
    if (!crossing.empty()) return say("pre-asymptotic", crossing + ", which makes its norm dip there");
    return say("not-refined", "fewer than three levels have an error above round-off");
  }
  if (is_constant) return say("not-refined", "refinement changes nothing at all");
  Judgement judgement = judge(fitted, *known, *order, *local, context.allowed);
  if (sign_change == 0 && selection.sign_changes > 1) {
    judgement.reason += fmt::format("; the signed error changes its sign {} times", selection.sign_changes);
  }
  if (!crossing.empty()) judgement.reason += "; " + crossing + ": levels before that are left out";
  if (context.time_error_share.value_or(0.0) > time_remark) {
    judgement.reason += fmt::format("; errors in time may be {:.0f}% of these",
                                    std::min(999.0, 100.0 * *context.time_error_share));
  }
  return say(judgement.verdict, judgement.reason);
}

LadderExtent extent_of(std::vector<LadderLevel> const& levels, double times_spacing) {
  UsedLevels const used = used_levels(levels);
  if (used.first >= used.above_round_off.size()) return {};
  return {times_spacing / used.above_round_off[used.first]->spacing,
          times_spacing / used.above_round_off.back()->spacing};
}

TargetResolution resolution_for(ObservedOrder const& observed, double error, LadderExtent const& extent) {
  TargetResolution target;
  target.error = error;
  if (observed.floor && observed.floor->lower > error) {
    target.remark = "never: the floor is above it";
    return target;
  }
  bool const is_told = observed.order || observed.floor;
  if (!is_told || !observed.law || observed.law->exponent <= 0.0 || observed.verdict == "diverging") {
    target.remark = "not known";
    return target;
  }
  ErrorLaw const& law = *observed.law;
  auto const at = [&](double resolution) {
    double const d = extent.finest / resolution;
    return law.floor + law.coefficient * std::pow(d, law.exponent) *
                           (1.0 + law.next_coefficient * std::pow(d, law.next_exponent));
  };
  double low = extent.coarsest, high = farthest * extent.finest;
  if (at(low) <= error) {
    target.resolution = low;
    target.remark = coarsest_has_it;
    return target;
  }
  if (at(high) > error) {
    target.remark = law.floor > error ? "not known: a floor may be above it"
                                      : "not within a million times the finest resolution";
    return target;
  }
  for (int k = 0; k < 60; ++k) {
    double const middle = std::sqrt(low * high);
    (at(middle) > error ? low : high) = middle;
  }
  target.resolution = high;
  if (high > extent.finest * (1.0 + 1e-9)) target.remark = "beyond the levels that were run";
  return target;
}

}  // namespace sphverify
