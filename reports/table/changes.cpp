// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/changes.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "reports/table/changes_level.hpp"
#include "reports/table/changes_match.hpp"
#include "reports/table/series_row.hpp"

namespace sphverify {

namespace {

/// Relative changes smaller than this are rounding, however far a run carries it: the part below which an
/// error counts as not having changed at all when orders are judged.
constexpr double unchanged = 1e-6;
/// Of what is relative to a whole: tables show less as 0%.
constexpr double shown_as_zero = 1e-11;
/// The share of the time error in the space error that runs are held to.
constexpr double largest_time_error_share = 0.01;

/// In the order of the tables.
constexpr std::array<char const*, 10> measures{
    "status",       "error",         "order",        "verdict",        "wall flux",
    "wall impulse", "shock plateau", "energy drift", "momentum drift", "time error share"};

/// A level's mean over its seeds.
struct Mean {
  double variance = 0.0;
  double degrees_of_freedom = 1.0;
};

Mean mean_of(Series const& series, SeriesRow const& row, std::string const& region) {
  for (OrderEntry const& entry : series.orders) {
    if (entry.field != row.field || entry.norm != row.norm || entry.region != region) continue;
    for (SeriesLevel const& level : entry.levels) {
      if (level.resolution != row.finest || !level.spread || level.replicates < 2) continue;
      double const n = level.replicates;
      return {*level.spread * *level.spread / n, n - 1.0};
    }
  }
  return {};
}

/// By how much two means of the same may differ in 95 of 100 cases: Student's quantile, which is large for
/// few seeds, with the degrees of freedom of Welch, as the scatters need not be the same.
double scatter(Mean const& a, Mean const& b) {
  double const variance = a.variance + b.variance;
  if (variance == 0.0) return 0.0;
  // Shares, because the square of a small variance is 0.
  double const share_a = a.variance / variance;
  double const share_b = b.variance / variance;
  double const degrees_of_freedom =
      1.0 / (share_a * share_a / a.degrees_of_freedom + share_b * share_b / b.degrees_of_freedom);
  return gsl_cdf_tdist_Pinv(0.975, degrees_of_freedom) * std::sqrt(variance);
}

bool any_timed_out(std::map<int, ComparedLevel> const& levels) {
  return std::any_of(levels.begin(), levels.end(), [](auto const& entry) { return entry.second.timed_out; });
}

/// Of every level.
std::vector<std::multiset<std::uint64_t>> seeds_of(std::map<int, ComparedLevel> const& levels) {
  std::vector<std::multiset<std::uint64_t>> seeds;
  for (auto const& [resolution, level] : levels) seeds.push_back(level.seeds);
  return seeds;
}

std::vector<int> resolutions_of(std::map<int, ComparedLevel> const& levels) {
  std::vector<int> resolutions;
  for (auto const& [resolution, level] : levels) resolutions.push_back(resolution);
  return resolutions;
}

Number magnitude(Number const& value) { return value ? Number(std::abs(*value)) : Number(); }

/// Collects what became of every number.
class Collector {
 public:
  /// @param must_repeat the same runs, to which the same build on the same machine can do nothing else
  Collector(Changes& changes, bool must_repeat) : changes_(changes), must_repeat_(must_repeat) {}

  void set_place(Change place) { place_ = std::move(place); }

  /// How far the numbers are off by their steps is not known: of those that differ nothing can be said.
  void leave_out_what_differs() { tells_differences_ = false; }
  bool left_out() const { return left_out_; }

  /// Compares two numbers if both exist.
  /// @param more_is_better else less is
  /// @param size the change in powers of 2, where not their ratio
  void number(std::string const& measure, Number const& before, Number const& after, double noise,
              bool more_is_better = false, std::optional<double> size = std::nullopt) {
    if (!before || !after) return;
    MeasureCount& count = count_of(measure);
    if (*before == *after) {
      ++count.same;
      return;
    }
    if (must_repeat_) ++changes_.not_repeated;
    if (!tells_differences_) {
      left_out_ = true;
      return;
    }
    if (std::abs(*after - *before) <= noise) {
      ++count.within_noise;
      return;
    }
    bool const is_better = (*after > *before) == more_is_better;
    ++(is_better ? count.better : count.worse);
    Change change = place_;
    change.measure = measure;
    change.direction = is_better ? "better" : "worse";
    change.before = before;
    change.after = after;
    change.noise = noise;
    double const least = std::max(noise, std::numeric_limits<double>::min());
    change.size = size.value_or(
        std::abs(std::log2(std::max(std::abs(*after), least) / std::max(std::abs(*before), least))));
    changes_.list.push_back(std::move(change));
  }

  /// @param direction of the change, if they differ
  void word(std::string const& measure, std::string const& before, std::string const& after,
            std::string const& direction, double size) {
    MeasureCount& count = count_of(measure);
    if (before == after) {
      ++count.same;
      return;
    }
    if (must_repeat_) ++changes_.not_repeated;
    ++(direction == "better" ? count.better : direction == "worse" ? count.worse : count.changed);
    Change change = place_;
    change.measure = measure;
    change.direction = direction;
    change.before_word = before;
    change.after_word = after;
    change.size = size;
    changes_.list.push_back(std::move(change));
  }

 private:
  MeasureCount& count_of(std::string const& measure) {
    auto const found = std::find_if(changes_.counts.begin(), changes_.counts.end(),
                                    [&](MeasureCount const& c) { return c.measure == measure; });
    if (found != changes_.counts.end()) return *found;
    changes_.counts.push_back({measure});
    return changes_.counts.back();
  }

  Changes& changes_;
  bool must_repeat_;
  bool tells_differences_ = true;
  bool left_out_ = false;
  Change place_;
};

std::string status_of(SeriesRow const& row) { return row.failures.empty() ? "ok" : row.failures; }

std::string direction_of_status(std::string const& before, std::string const& after) {
  return before == "ok" ? "worse" : after == "ok" ? "better" : "changed";
}

/// Two series at one level, and by how much their numbers may differ for no reason.
struct Pair {
  SeriesRow before, after;
  ComparedLevel before_level, after_level;
  double scatter = 0.0;  ///< of the error's mean, if the seeds are others
  bool same_ladder = false;
  bool same_seeds = false;
};

/// What the steps that an adaptive method happens to take leave in the drift: both tolerances, or twice the
/// smaller of what they left. A method that keeps less to its budget than it did is no noise.
double step_noise(Pair const& pair) {
  double const tolerances = pair.before_level.tolerance + pair.after_level.tolerance;
  Number const before = magnitude(pair.before.energy_step_drift);
  Number const after = magnitude(pair.after.energy_step_drift);
  if (tolerances == 0.0 || !before || !after) return 0.0;
  return std::max(tolerances, 2.0 * std::min(*before, *after));
}

void compare_numbers(Pair const& pair, Collector& collect) {
  SeriesRow const& before = pair.before;
  SeriesRow const& after = pair.after;
  double const shares =
      pair.before_level.time_error_share.value_or(0.0) + pair.after_level.time_error_share.value_or(0.0);
  auto const relative_noise = [&](Number const& a, Number const& b, double part, double floor) {
    return part * std::max(std::abs(a.value_or(0.0)), std::abs(b.value_or(0.0))) + floor;
  };
  double const round_off = pair.before_level.round_off + pair.after_level.round_off;
  if (before.field == after.field && before.norm == after.norm) {
    collect.number(
        "error", before.error, after.error,
        relative_noise(before.error, after.error, std::max(shares, unchanged), round_off + pair.scatter));
    if (pair.same_ladder && before.half_width && after.half_width && before.order && after.order) {
      collect.number("order", before.order, after.order, std::hypot(*before.half_width, *after.half_width),
                     true, std::abs(*after.order - *before.order));
    }
    if (pair.same_ladder) collect.word("verdict", before.verdict, after.verdict, "changed", 0.0);
  }
  // Only the error knows its scatter.
  if (!pair.same_seeds) return;
  auto const relative = [&](char const* measure, Number SeriesRow::*member, double floor) {
    Number const a = magnitude(before.*member);
    Number const b = magnitude(after.*member);
    collect.number(measure, a, b, relative_noise(a, b, std::max(shares, unchanged), floor));
  };
  // A flux takes part of the temperature's time error.
  double const flux_share =
      shares * std::max(before.relative_error.value_or(0.0), after.relative_error.value_or(0.0));
  relative("wall flux", &SeriesRow::wall_flux_error, flux_share + shown_as_zero);
  relative("wall impulse", &SeriesRow::wall_impulse_defect, shown_as_zero);
  relative("shock plateau", &SeriesRow::plateau_pressure, shown_as_zero);
  relative("energy drift", &SeriesRow::energy_drift,
           step_noise(pair) + before.energy_rounding.value_or(0.0) + after.energy_rounding.value_or(0.0));
  relative("momentum drift", &SeriesRow::momentum_drift,
           before.momentum_rounding.value_or(0.0) + after.momentum_rounding.value_or(0.0));
  if (!pair.same_ladder) return;  // it is that of the whole ladder
  collect.number("time error share", before.time_error_share, after.time_error_share,
                 relative_noise(before.time_error_share, after.time_error_share, unchanged,
                                pair.before_level.tolerance > 0.0 ? largest_time_error_share : 0.0));
}

Change place_of(Series const& series, int resolution) {
  Change place;
  place.setting = setting_of("", series);
  place.setting.discretisation = without_seed(series.discretisation);
  place.case_id = series.case_id;
  place.parameters = series.parameters;
  place.formulation = series.label;
  place.resolution = resolution;
  return place;
}

void compare_series(NamedResults const& before, Series const& a, NamedResults const& after, Series const& b,
                    std::string const& region, std::string const& norm, Changes& changes) {
  std::string const field = series_row(before, a, region, norm).field;
  auto const before_levels = levels_of(a, before.results.runs, field, region);
  auto const after_levels = levels_of(b, after.results.runs, field, region);
  std::optional<int> const common = finest_common(before_levels, after_levels);
  if (!common) {
    changes.not_comparable.push_back(name_of(a));
    return;
  }
  Pair pair{series_row(before, a, region, norm, common), series_row(after, b, region, norm, common),
            before_levels.at(*common), after_levels.at(*common)};
  pair.same_ladder = resolutions_of(before_levels) == resolutions_of(after_levels);
  pair.same_seeds = pair.before_level.seeds == pair.after_level.seeds;
  if (!pair.same_seeds)
    pair.scatter = scatter(mean_of(a, pair.before, region), mean_of(b, pair.after, region));
  // An order is of the whole ladder.
  bool const same_runs =
      pair.same_ladder ? seeds_of(before_levels) == seeds_of(after_levels) : pair.same_seeds;
  Collector collect(changes, same_runs && !any_timed_out(before_levels) && !any_timed_out(after_levels));
  collect.set_place(place_of(b, *common));
  std::string const status_before = status_of(pair.before);
  std::string const status_after = status_of(pair.after);
  collect.word("status", status_before, status_after, direction_of_status(status_before, status_after),
               std::numeric_limits<double>::infinity());
  if (status_before != "ok" || status_after != "ok") return;
  if (!pair.before_level.time_error_share || !pair.after_level.time_error_share)
    collect.leave_out_what_differs();
  compare_numbers(pair, collect);
  if (collect.left_out()) changes.unknown_noise.push_back(name_of(a));
}

/// The last value that held is known to the width of the bracket.
double bracket(Envelope const& e) { return e.held && e.failed ? std::abs(*e.failed - *e.held) : 0.0; }

std::string status_of(Envelope const& e) { return e.failed ? e.status : "ok"; }

/// Whether the parameter was driven to larger values. The hardest is tried first.
bool goes_up(Envelope const& a, Envelope const& b) {
  for (Envelope const* e : {&a, &b}) {
    if (e->points.size() > 1) return e->points[0].value > e->points[1].value;
  }
  return true;
}

/// From where to where the parameter was driven; the start is tried only if the end did not hold.
bool same_range(Envelope const& a, Envelope const& b) {
  std::size_t const known = std::min({a.points.size(), b.points.size(), std::size_t{2}});
  return std::equal(a.points.begin(), a.points.begin() + static_cast<std::ptrdiff_t>(known), b.points.begin(),
                    [](Envelope::Point const& x, Envelope::Point const& y) { return x.value == y.value; });
}

/// Whether the same values were tried as far as the outcomes were the same, and load decided none of them.
bool same_search(Envelope const& a, Envelope const& b) {
  auto const was_bisected = [](Envelope const& e) {
    return e.points.size() > 1 && e.points[1].status == "ok";
  };
  auto const any_timed_out = [](Envelope const& e) {
    return std::any_of(e.points.begin(), e.points.end(),
                       [](Envelope::Point const& p) { return p.status == timed_out; });
  };
  bool const same_bisections = !was_bisected(a) || !was_bisected(b) || a.points.size() == b.points.size();
  return same_bisections && !any_timed_out(a) && !any_timed_out(b);
}

void compare_envelopes(Envelope const& a, Envelope const& b, Changes& changes) {
  if (!same_range(a, b)) {
    changes.not_comparable.push_back(name_of(a));
    return;
  }
  Collector collect(changes, same_search(a, b));
  Change place;
  place.setting = {"", b.formulation, b.discretisation, 0.0, b.resolution};
  place.case_id = b.case_id;
  place.parameters = b.parameters;
  place.formulation = b.label;
  place.resolution = b.resolution;
  collect.set_place(std::move(place));
  collect.word("how it fails", status_of(a), status_of(b), direction_of_status(status_of(a), status_of(b)),
               std::numeric_limits<double>::infinity());
  if (a.held.has_value() != b.held.has_value()) {
    auto const text = [](Envelope const& e) { return e.held ? fmt::format("{:.4g}", *e.held) : "none"; };
    collect.word("held to", text(a), text(b), b.held ? "better" : "worse",
                 std::numeric_limits<double>::infinity());
    return;
  }
  std::optional<double> size;
  double const noise = std::max(bracket(a), bracket(b));
  if (!b.logarithmic && a.held && noise > 0.0) size = std::abs(*b.held - *a.held) / noise;
  collect.number("held to", a.held, b.held, noise, goes_up(a, b), size);
}

Changes compare_two(NamedResults const& before, NamedResults const& after, std::string const& region,
                    std::string const& norm) {
  Changes changes;
  changes.before = &before;
  changes.after = &after;
  Context const& a = before.results.context;
  Context const& b = after.results.context;
  changes.same_machine = a.commit == b.commit && !a.commit.ends_with("-dirty") && a.commit != "unknown" &&
                         a.compiler == b.compiler && a.flags == b.flags && a.processor == b.processor &&
                         a.added.empty() && b.added.empty();  // of these the commit says nothing
  for (char const* measure : measures) changes.counts.push_back({measure});
  match_all(before.results.series, after.results.series, changes, [&](Series const& s, Series const& t) {
    compare_series(before, s, after, t, region, norm, changes);
  });
  match_all(before.results.envelopes, after.results.envelopes, changes,
            [&](Envelope const& e, Envelope const& f) { compare_envelopes(e, f, changes); });
  std::erase_if(changes.counts, [](MeasureCount const& c) {
    return c.same + c.within_noise + c.better + c.worse + c.changed == 0;
  });
  std::stable_sort(changes.list.begin(), changes.list.end(),
                   [](Change const& x, Change const& y) { return x.size > y.size; });
  return changes;
}

}  // namespace

std::vector<Changes> changes_of(std::vector<NamedResults> const& documents, std::string const& region,
                                std::string const& norm) {
  std::vector<Changes> all;
  for (std::size_t k = 1; k < documents.size(); ++k)
    all.push_back(compare_two(documents.front(), documents[k], region, norm));
  return all;
}

}  // namespace sphverify
