// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/gate/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "harness/gate/measure.hpp"
#include "harness/gate/reference_accuracy.hpp"
#include "harness/gate/select.hpp"
#include "reports/json/results_json.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// What came of one run or series; the larger the badness, the worse within the same outcome.
struct Outcome {
  enum Kind { passed, within_noise, undecided, failed } kind = passed;
  double badness = 0.0;
  /// Whether there is a number (or a word that says as much), and it is on the wrong side of the limit.
  bool on_wrong_side = false;
  Measured measured;
  Number baseline;
  double tolerance = 0.0;  ///< about the baseline
};

bool worse(Outcome const& a, Outcome const& b) {
  return a.kind != b.kind ? a.kind > b.kind : a.badness > b.badness;
}

Outcome judge_range(Gate const& gate, Measured const& m) {
  bool const interval_known = m.lower && m.upper;
  bool const by_interval = gate.interval_decides && interval_known;
  double const lower = by_interval ? *m.lower : *m.value;
  double const upper = by_interval ? *m.upper : *m.value;
  double const minimum = gate.limit.minimum.value_or(-unlimited);
  double const maximum = gate.limit.maximum.value_or(unlimited);
  Outcome outcome;
  // How far the value is beyond the nearer limit.
  outcome.badness = std::max(minimum - *m.value, *m.value - maximum);
  if (upper < minimum || lower > maximum) {
    outcome.kind = Outcome::failed;
    outcome.on_wrong_side = true;
  } else if (lower < minimum || upper > maximum) {
    outcome.kind = Outcome::undecided;
  }
  bool const may_be_noise = gate.interval_decides && m.kindest_lower && m.kindest_upper;
  if (outcome.kind != Outcome::passed && may_be_noise && *m.kindest_lower >= minimum &&
      *m.kindest_upper <= maximum) {
    outcome.kind = Outcome::within_noise;
    outcome.on_wrong_side = outcome.badness > 0.0;
  }
  // Without an interval nothing says that an order is not noise.
  if (gate.measure == GateMeasure::order && gate.interval_decides && !interval_known &&
      outcome.kind == Outcome::passed) {
    outcome.kind = Outcome::undecided;
  }
  return outcome;
}

/// Whether a word tells something of the scheme. A run that its time budget ended, or that could not be set
/// up, tells of the machine or the document; a ladder of too few levels tells nothing.
bool tells(Gate const& gate, std::string const& word) {
  if (gate.measure == GateMeasure::order) return word != "not-refined";
  return word == "ok" || word == "unstable" || word == "non-finite" || word == "positivity-lost";
}

Outcome judge_equals(Gate const& gate, Measured const& m) {
  Outcome outcome;
  bool const equal = gate.limit.equals ? *m.value == *gate.limit.equals : m.word == gate.limit.equals_word;
  outcome.kind = equal ? Outcome::passed : Outcome::failed;
  outcome.on_wrong_side = !equal && (gate.limit.equals || tells(gate, m.word));
  if (gate.limit.equals) outcome.badness = std::abs(*m.value - *gate.limit.equals);
  return outcome;
}

/// Whether the interval is that of timings alone, and no bound.
bool is_of_timings(Measured const& m) {
  return m.kindest_lower && *m.kindest_lower == *m.upper && *m.kindest_upper == *m.lower;
}

/// How far two ratios of times are apart at least.
double gap(Measured const& a, Measured const& b) {
  if (!is_of_timings(a) || !is_of_timings(b)) return unlimited;
  return std::max({0.0, *a.lower - *b.upper, *b.lower - *a.upper});
}

/// What a baseline that is zero but for rounding may be changed by is not a part of it, but rounding.
double tolerance_of(Tolerance const& within, Measured const& now, Measured const& old) {
  double const baseline = std::abs(*old.value);
  double const given = std::max(within.relative.value_or(0.0) * baseline, within.absolute.value_or(0.0));
  double const rounding = std::max(now.round_off.value_or(0.0), old.round_off.value_or(0.0));
  return within.absolute || baseline > rounding ? given : std::max(given, rounding);
}

Outcome judge_within(Gate const& gate, Measured const& m, std::vector<Measured> const& baseline) {
  Outcome outcome;
  auto const old = std::find_if(baseline.begin(), baseline.end(),
                                [&](Measured const& other) { return same_subject(m, other); });
  outcome.kind = Outcome::failed;
  outcome.badness = unlimited;
  if (old == baseline.end() || !old->value) {
    outcome.measured.problem = old == baseline.end() ? "not in the baseline" : "baseline: " + old->problem;
    return outcome;
  }
  outcome.baseline = old->value;
  double const difference = std::abs(*m.value - *old->value);
  double const tolerance = outcome.tolerance = tolerance_of(*gate.limit.within, m, *old);
  outcome.on_wrong_side = difference > tolerance;
  outcome.kind = outcome.on_wrong_side ? Outcome::failed : Outcome::passed;
  if (outcome.kind == Outcome::failed && gate.interval_decides && gap(m, *old) <= tolerance)
    outcome.kind = Outcome::within_noise;
  outcome.badness = difference == 0.0 ? 0.0 : difference / tolerance;
  if (outcome.kind == Outcome::failed && tolerance == 0.0 && *old->value == 0.0 &&
      !gate.limit.within->absolute)
    outcome.measured.problem =
        "the baseline is 0, and nothing is known of its rounding: give within.absolute";
  return outcome;
}

/// A ladder on a floor, or away from the solution, has a slope but no order.
bool is_no_order(Measured const& m) { return m.word == "floored" || m.word == "diverging"; }

Outcome judge_one(Gate const& gate, Measured const& m, std::vector<Measured> const& baseline) {
  Outcome outcome;
  bool const of_word = !gate.limit.equals_word.empty() && !m.word.empty();
  if (!m.value && !of_word) {
    outcome.kind = Outcome::failed;
    outcome.badness = unlimited;
  } else if (gate.limit.within) {
    outcome = judge_within(gate, m, baseline);
  } else if (gate.limit.equals || of_word) {
    outcome = judge_equals(gate, m);
  } else {
    outcome = judge_range(gate, m);
  }
  if (m.value && gate.measure == GateMeasure::order && gate.verdict_decides &&
      gate.limit.equals_word.empty() && is_no_order(m)) {
    outcome.kind = Outcome::failed;
  }
  std::string const problem = outcome.measured.problem;
  outcome.measured = m;
  if (!problem.empty()) outcome.measured.problem = problem;
  return outcome;
}

std::string show(double value) { return fmt::format("{:.3g}", value); }

std::string show_measured(Gate const& gate, Measured const& m) {
  std::string const label = label_of(gate);
  if (!gate.limit.equals_word.empty() && !m.word.empty()) return label + " " + m.word;
  if (!m.value) return label + " unknown";
  std::string text = fmt::format("{} {}", label, show(*m.value));
  if (std::string const unit = unit_of(gate, field_of(gate, m)); !unit.empty()) text += " " + unit;
  if (m.lower && m.upper) text += fmt::format(" [{:.3g}, {:.3g}]", *m.lower, *m.upper);
  return text;
}

std::string show_limit(Gate const& gate, Number const& baseline, double tolerance) {
  Limit const& limit = gate.limit;
  if (!limit.equals_word.empty()) return "= " + limit.equals_word;
  if (limit.equals) return fmt::format("= {}", *limit.equals);
  if (limit.minimum && limit.maximum) return fmt::format("in [{}, {}]", *limit.minimum, *limit.maximum);
  if (limit.minimum) return fmt::format(">= {}", *limit.minimum);
  if (limit.maximum) return fmt::format("<= {}", *limit.maximum);
  if (baseline) return fmt::format("{} +- {:.2g}", show(*baseline), tolerance);
  return "as the baseline";
}

/// Why an outcome is not a pass, where the numbers alone do not say it.
std::string explain(Gate const& gate, Outcome const& worst) {
  Measured const& m = worst.measured;
  if (!m.problem.empty()) return m.problem;
  if (worst.kind == Outcome::passed) return "";
  if (gate.measure == GateMeasure::status && worst.kind == Outcome::failed) return m.run->reason;
  if (worst.kind == Outcome::within_noise) return "the timings are too noisy to tell";
  if (worst.kind == Outcome::undecided) {
    if (m.lower) return "the limit lies inside the interval";
    return "no interval" + (m.remark.empty() ? "" : ": " + m.remark);
  }
  if (gate.measure == GateMeasure::order && gate.limit.equals_word.empty() && is_no_order(m)) {
    return fmt::format("the ladder is {}{}", m.word, m.remark.empty() ? "" : ": " + m.remark);
  }
  return "";
}

/// What the baseline holds and the results lack: a run that is lost must not pass unseen.
std::vector<Measured> lost(std::vector<Measured> const& now, std::vector<Measured> const& baseline) {
  std::vector<Measured> all;
  for (Measured const& old : baseline) {
    auto const same = [&](Measured const& m) { return same_subject(m, old); };
    if (std::any_of(now.begin(), now.end(), same)) continue;
    all.push_back(old);
    all.back().value.reset();
    all.back().problem = "in the baseline, but no longer in the results";
  }
  return all;
}

Verdict verdict_of(Outcome const& worst) {
  switch (worst.kind) {
    case Outcome::passed:
      return Verdict::passed;
    case Outcome::within_noise:
      return Verdict::within_noise;
    case Outcome::undecided:
      return Verdict::undecided;
    case Outcome::failed:
      break;
  }
  return Verdict::failed;
}

/// What hides whether an expected failure is still there: no number, or one that decides nothing.
bool hides(Outcome const& outcome) { return outcome.kind != Outcome::passed && !outcome.on_wrong_side; }

/// The verdict where a failure is expected.
Verdict verdict_of_expected(Outcome const& worst) {
  if (worst.kind == Outcome::passed) return Verdict::unexpected_pass;
  if (!hides(worst)) return Verdict::expected_failure;
  return worst.kind == Outcome::failed ? Verdict::failed : Verdict::undecided;
}

/// Puts what a gate selected beside what it must; empty if that is as it must be.
std::optional<GateVerdict> judge_selection(Gate const& gate, Results const& results, std::size_t selected) {
  GateVerdict verdict;
  verdict.name = gate.name;
  verdict.reason = gate.reason;
  verdict.verdict = Verdict::selects_nothing;
  verdict.measured = label_of(gate) + " of nothing";
  verdict.limit = show_limit(gate, std::nullopt, 0.0);
  if (selected == 0) {
    verdict.detail = why_empty(gate, results);
    return verdict;
  }
  auto const& [exactly, at_least] = gate.count;
  if (!exactly && !at_least) {
    verdict.detail = unmatched_entry(gate, results);
    return verdict.detail.empty() ? std::nullopt : std::optional(verdict);
  }
  if (exactly ? selected == *exactly : selected >= *at_least) return std::nullopt;
  std::string const what = is_of_series(gate.measure) ? "ladder" : "run";
  verdict.verdict = Verdict::failed;
  verdict.measured = fmt::format("{} {}{}", selected, what, selected == 1 ? "" : "s");
  verdict.limit = exactly ? fmt::format("= {}", *exactly) : fmt::format(">= {}", *at_least);
  verdict.detail = fmt::format("it looks at {} where '{}' says {}", verdict.measured,
                               exactly ? "runs" : "at_least", exactly ? *exactly : *at_least);
  return verdict;
}

GateVerdict judge_gate(Gate const& gate, Results const& results, Baselines const& baselines,
                       std::string const& file) {
  std::vector<Measured> all = measure(gate, results, file);
  if (auto const wrong = judge_selection(gate, results, all.size())) return *wrong;
  for (Measured const& m : all) require_reachable(gate, m, file);
  std::vector<Measured> baseline;
  if (gate.limit.within) {
    baseline = measure_baseline(gate, baselines.at(gate.limit.baseline));
    std::vector<Measured> const missing = lost(all, baseline);
    all.insert(all.end(), missing.begin(), missing.end());
  }
  std::vector<Outcome> outcomes;
  for (Measured const& m : all) outcomes.push_back(judge_one(gate, m, baseline));
  auto const worst =
      std::max_element(outcomes.begin(), outcomes.end(), [&](Outcome const& a, Outcome const& b) {
        // An expected failure must not hide another one.
        if (gate.expect_failure && hides(a) != hides(b)) return hides(b);
        return worse(b, a);
      });
  GateVerdict verdict;
  verdict.name = gate.name;
  verdict.reason = gate.reason;
  verdict.verdict = gate.expect_failure ? verdict_of_expected(*worst) : verdict_of(*worst);
  verdict.measured = show_measured(gate, worst->measured);
  verdict.limit = show_limit(gate, worst->baseline, worst->tolerance);
  verdict.where = describe(worst->measured);
  verdict.detail = explain(gate, *worst);
  if (gate.expect_failure && !holds(verdict.verdict) && verdict.verdict != Verdict::unexpected_pass)
    verdict.detail =
        "not the failure that is expected" + (verdict.detail.empty() ? "" : ": " + verdict.detail);
  verdict.looked_at = outcomes.size();
  verdict.failing =
      static_cast<std::size_t>(std::count_if(outcomes.begin(), outcomes.end(), [](Outcome const& outcome) {
        return outcome.kind > Outcome::within_noise;
      }));
  return verdict;
}

}  // namespace

std::string_view word(Verdict verdict) {
  switch (verdict) {
    case Verdict::passed:
      return "passed";
    case Verdict::within_noise:
      return "within-noise";
    case Verdict::failed:
      return "failed";
    case Verdict::undecided:
      return "undecided";
    case Verdict::expected_failure:
      return "expected-failure";
    case Verdict::unexpected_pass:
      return "unexpected-pass";
    case Verdict::selects_nothing:
      return "selects-nothing";
  }
  return "";
}

Baselines read_baselines(Gates const& gates, std::string const& results_path) {
  Baselines baselines;
  for (Gate const& gate : gates.gates) {
    std::string const& path = gate.limit.baseline;
    if (path.empty() || baselines.contains(path)) continue;
    std::error_code none;
    if (std::filesystem::equivalent(path, results_path, none)) {
      throw UserError(gates.file, gate.key + ".baseline", "the results themselves", "stored results");
    }
    baselines.emplace(path, read_whole_results(path));
  }
  return baselines;
}

std::vector<GateVerdict> judge(Gates const& gates, Results const& results, Baselines const& baselines) {
  std::vector<GateVerdict> verdicts;
  for (Gate const& gate : gates.gates) verdicts.push_back(judge_gate(gate, results, baselines, gates.file));
  return verdicts;
}

}  // namespace sphverify
