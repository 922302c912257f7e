// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "harness/gate/measure.hpp"
#include "harness/gate/measuring.hpp"
#include "harness/gate/select.hpp"
#include "harness/measure/timing.hpp"
#include "reports/table/time_ratio.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

namespace {

/// The one that differs in the formulation alone; null if there is none. Throws UserError for several.
template <class Subject, class Same>
Subject const* find_reference(Measuring const& measuring, std::vector<Subject> const& all,
                              FormulationChoice const& f, Same const& same) {
  FormulationMatch const& wanted = measuring.gate.relative_to;
  std::vector<Subject const*> found;
  for (Subject const& other : all) {
    bool const walls = wanted.walls || other.formulation.walls == f.walls;
    if (matches(wanted, other.formulation) && walls && same(other)) found.push_back(&other);
  }
  if (found.size() > 1) {
    // Partners that are not named are those of the formulation itself.
    auto const others = std::remove_if(found.begin(), found.end(), [&](Subject const* other) {
      return (!wanted.work && other->formulation.work != f.work) ||
             (!wanted.conduction && other->formulation.conduction != f.conduction);
    });
    if (others != found.begin()) found.erase(others, found.end());
  }
  if (found.size() > 1 && measuring.file != nullptr) {
    std::vector<std::string> labels;
    for (Subject const* other : found) labels.push_back(other->label);
    throw UserError(*measuring.file, measuring.gate.key + ".relative_to",
                    fmt::format("{}", fmt::join(labels, " and ")), "work or conduction that tell them apart");
  }
  return found.empty() ? nullptr : found.front();
}

void name_reference(Measuring& measuring) {
  FormulationMatch const& wanted = measuring.gate.relative_to;
  std::set<std::string> ids;
  bool found = false;
  for (RunRecord const& run : measuring.results.runs) {
    ids.insert(run.formulation.id);
    found = found || matches(wanted, run.formulation);
  }
  // Partners or walls that no run has.
  if (!found) ids.erase(wanted.id);
  measuring.name("relative_to", wanted.id, ids);
}

bool same_setting(Series const& a, Series const& b) {
  return a.case_id == b.case_id && a.parameters == b.parameters && a.discretisation == b.discretisation &&
         a.smoothing_exponent == b.smoothing_exponent;
}
bool same_setting(RunRecord const& a, RunRecord const& b) {
  return a.case_id == b.case_id && a.parameters == b.parameters && a.discretisation == b.discretisation &&
         a.smoothing_exponent == b.smoothing_exponent && a.resolution == b.resolution;
}

TimeToTarget of_target(TimeToError const& t) { return {t.seconds, t.median, t.is_bound}; }

/// The interval of a ratio of times: a gate may take any number in it.
void put_noise(Measured& m, TimeRatio const& ratio) {
  m.lower = m.kindest_upper = ratio.low;
  m.upper = m.kindest_lower = ratio.high;
}

/// Ratio of two runs' times: round by round where they took turns, else that of their medians.
std::optional<TimeRatio> ratio_of(Cost const& own, Cost const& its) {
  if (MedianSeconds const paired = median_ratio(own, its); paired.low)
    return TimeRatio{*paired.median, paired.low, paired.high};
  return time_ratio({own.seconds, own.median}, {its.seconds, its.median});
}

}  // namespace

std::vector<Quantity<Cost>> const& cost_table() {
  auto const count = [](std::uint64_t Cost::*member) {
    return [member](Cost const& c) { return c.is_counted() ? Number(static_cast<double>(c.*member)) : Number(); };
  };
  static std::vector<Quantity<Cost>> const table{
      {"seconds", [](Cost const& c) { return Number(c.seconds); }, ""},
      {"median_seconds", [](Cost const& c) { return c.median.median; }, ""},
      {"cpu_seconds", [](Cost const& c) { return c.cpu_seconds; }, ""},
      {"setup_seconds", [](Cost const& c) { return c.is_counted() ? Number(c.setup_seconds) : Number(); }, ""},
      {"steps", count(&Cost::steps), ""},
      {"rate_evaluations", count(&Cost::rate_evaluations), ""},
      {"pair_interactions", count(&Cost::pair_interactions), ""},
      {"peak_bytes", [](Cost const& c) { return c.peak_bytes > 0 ? Number(static_cast<double>(c.peak_bytes)) : Number(); }, ""}};
  return table;
}

std::vector<std::string> const& cost_quantities() {
  static std::vector<std::string> const names = [] {
    std::vector<std::string> all;
    for (auto const& quantity : cost_table()) all.emplace_back(quantity.name);
    return all;
  }();
  return names;
}

/// The time of a series, which is at most that where its coarsest level was good enough already.
void measure_time_to_error(Measuring& measuring, Measured& m) {
  Gate const& gate = measuring.gate;
  name_reference(measuring);
  Series const* const other =
      find_reference(measuring, measuring.results.series, m.series->formulation,
                     [&](Series const& candidate) { return same_setting(candidate, *m.series); });
  if (other == nullptr) {
    m.problem = fmt::format("{} was not run on this", gate.relative_to.id);
    return;
  }
  if (m.series->is_timed_apart || other->is_timed_apart) {
    m.problem = "runs of the study were timed on several machines, whose times are not compared";
    return;
  }
  TimeToError const* const own = find_entry(measuring, m.series->time_to_error, field_of(gate, m));
  std::set<std::string> targets;
  for (TimeToError const& t : m.series->time_to_error) targets.insert(fmt::format("{}", t.relative));
  if (!m.series->time_to_error.empty()) measuring.name("target", fmt::format("{}", gate.target), targets);
  Measured reference;
  reference.series = other;
  TimeToError const* const its = find_entry(measuring, other->time_to_error, field_of(gate, reference));
  auto const reached = [](TimeToError const* t) { return t != nullptr && t->seconds && *t->seconds > 0.0; };
  if (!reached(own) || !reached(its)) {
    m.problem = fmt::format("{} never reached {:g} of the exact norm",
                            reached(own) ? other->label : m.series->label, gate.target);
    return;
  }
  std::optional<TimeRatio> const known = time_ratio(of_target(*own), of_target(*its));
  if (!known) {
    m.problem = fmt::format("the median run time of {} is zero", other->label);
    return;
  }
  TimeRatio const& ratio = *known;
  m.value = ratio.value;
  put_noise(m, ratio);
  if (!own->is_bound && !its->is_bound) return;
  double const infinity = std::numeric_limits<double>::infinity();
  m.lower = own->is_bound ? 0.0 : ratio.low.value_or(ratio.value);
  m.upper = its->is_bound ? infinity : ratio.high.value_or(ratio.value);
  if (!ratio.low) return;
  // Noise moves the closed end alone.
  if (own->is_bound) m.kindest_lower = 0.0;
  if (its->is_bound) m.kindest_upper = infinity;
}

void measure_cost(Measuring& measuring, Measured& m) {
  Gate const& gate = measuring.gate;
  name_reference(measuring);
  std::set<std::string> known;
  if (m.run->cost) known.insert("cost");
  if (!measuring.name("measure", "cost", known)) {
    m.problem = "cost was not measured";
    return;
  }
  RunRecord const* const other =
      find_reference(measuring, measuring.results.runs, m.run->formulation,
                     [&](RunRecord const& candidate) { return same_setting(candidate, *m.run); });
  if (other == nullptr || !other->cost || other->status != "ok") {
    m.problem = other == nullptr ? fmt::format("{} was not run on this", gate.relative_to.id)
                : other->cost    ? other->label + ": " + failure(*other)
                                 : other->label + ": cost was not measured";
    return;
  }
  auto const& quantity = find_quantity(cost_table(), gate.quantity);
  if (gate.quantity.ends_with("seconds") && m.run->cost->machine != other->cost->machine) {
    m.problem = fmt::format("{} was timed on another machine, and times of two machines are not compared", other->label);
    return;
  }
  Number const own = quantity.value(*m.run->cost);
  Number const its = quantity.value(*other->cost);
  put(m, own && its && *its > 0.0 ? Number(*own / *its) : Number(), gate.quantity + " is null or zero");
  if (!m.value || (gate.quantity != "seconds" && gate.quantity != "median_seconds")) return;
  auto ratio = ratio_of(*m.run->cost, *other->cost);
  if (!ratio || !ratio->low) return;
  if (gate.quantity == "median_seconds") m.value = ratio->value;
  // The minimum has no interval of its own: it takes that of the typical ratio, as far as that must be
  // widened to hold it.
  ratio->low = std::min(*ratio->low, *m.value);
  ratio->high = std::max(*ratio->high, *m.value);
  put_noise(m, *ratio);
}

}  // namespace sphverify
