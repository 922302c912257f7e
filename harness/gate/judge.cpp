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

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What came of one run or series; the larger the badness, the worse within the same outcome.
struct Outcome {
  enum Kind { passed, within_noise, undecided, failed } kind = passed;
  double badness = 0.0;
  Measured measured;
  Number baseline;
};

bool worse(Outcome const& a, Outcome const& b) {
  return a.kind != b.kind ? a.kind > b.kind : a.badness > b.badness;
}

Outcome judge_range(Gate const& gate, Measured const& m) {
  bool const interval_known = m.lower && m.upper;
  bool const by_interval = gate.interval_decides && interval_known;
  double const lower = by_interval ? *m.lower : *m.value;
  double const upper = by_interval ? *m.upper : *m.value;
  double const minimum = gate.limit.minimum.value_or(-infinity);
  double const maximum = gate.limit.maximum.value_or(infinity);
  Outcome outcome;
  // How far the value is beyond the nearer limit.
  outcome.badness = std::max(minimum - *m.value, *m.value - maximum);
  if (upper < minimum || lower > maximum) {
    outcome.kind = Outcome::failed;
  } else if (lower < minimum || upper > maximum) {
    outcome.kind = Outcome::undecided;
  }
  bool const may_be_noise = gate.interval_decides && m.kindest_lower && m.kindest_upper;
  if (outcome.kind != Outcome::passed && may_be_noise && *m.kindest_lower >= minimum &&
      *m.kindest_upper <= maximum) {
    outcome.kind = Outcome::within_noise;
  }
  // Without an interval nothing says that an order is not noise.
  if (gate.measure == GateMeasure::order && gate.interval_decides && !interval_known &&
      outcome.kind == Outcome::passed) {
    outcome.kind = Outcome::undecided;
  }
  return outcome;
}

Outcome judge_equals(Gate const& gate, Measured const& m) {
  Outcome outcome;
  bool const equal = gate.limit.equals ? *m.value == *gate.limit.equals : m.word == gate.limit.equals_word;
  outcome.kind = equal ? Outcome::passed : Outcome::failed;
  if (gate.limit.equals) outcome.badness = std::abs(*m.value - *gate.limit.equals);
  return outcome;
}

/// Whether the interval is that of timings alone, and no bound.
bool is_of_timings(Measured const& m) {
  return m.kindest_lower && *m.kindest_lower == *m.upper && *m.kindest_upper == *m.lower;
}

/// How far two ratios of times are apart at least.
double gap(Measured const& a, Measured const& b) {
  if (!is_of_timings(a) || !is_of_timings(b)) return infinity;
  return std::max({0.0, *a.lower - *b.upper, *b.lower - *a.upper});
}

double tolerance_of(Tolerance const& within, double baseline) {
  return std::max(within.relative.value_or(0.0) * std::abs(baseline), within.absolute.value_or(0.0));
}

Outcome judge_within(Gate const& gate, Measured const& m, std::vector<Measured> const& baseline) {
  Outcome outcome;
  auto const old = std::find_if(baseline.begin(), baseline.end(),
                                [&](Measured const& other) { return same_subject(m, other); });
  outcome.kind = Outcome::failed;
  outcome.badness = infinity;
  if (old == baseline.end() || !old->value) {
    outcome.measured.problem = old == baseline.end() ? "not in the baseline" : "baseline: " + old->problem;
    return outcome;
  }
  outcome.baseline = old->value;
  double const difference = std::abs(*m.value - *old->value);
  double const tolerance = tolerance_of(*gate.limit.within, *old->value);
  outcome.kind = difference <= tolerance ? Outcome::passed : Outcome::failed;
  if (outcome.kind == Outcome::failed && gate.interval_decides && gap(m, *old) <= tolerance)
    outcome.kind = Outcome::within_noise;
  outcome.badness = difference == 0.0 ? 0.0 : difference / tolerance;
  return outcome;
}

Outcome judge_one(Gate const& gate, Measured const& m, std::vector<Measured> const& baseline) {
  Outcome outcome;
  bool const of_word = !gate.limit.equals_word.empty() && !m.word.empty();
  if (!m.value && !of_word) {
    outcome.kind = Outcome::failed;
    outcome.badness = infinity;
  } else if (gate.limit.within) {
    outcome = judge_within(gate, m, baseline);
  } else if (gate.limit.equals || of_word) {
    outcome = judge_equals(gate, m);
  } else {
    outcome = judge_range(gate, m);
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

std::string show_limit(Gate const& gate, Number const& baseline) {
  Limit const& limit = gate.limit;
  if (!limit.equals_word.empty()) return "= " + limit.equals_word;
  if (limit.equals) return fmt::format("= {}", *limit.equals);
  if (limit.minimum && limit.maximum) return fmt::format("in [{}, {}]", *limit.minimum, *limit.maximum);
  if (limit.minimum) return fmt::format(">= {}", *limit.minimum);
  if (limit.maximum) return fmt::format("<= {}", *limit.maximum);
  if (baseline) return fmt::format("{} +- {:.2g}", show(*baseline), tolerance_of(*limit.within, *baseline));
  return "as the baseline";
}

/// Why an outcome is not a pass, where the numbers alone do not say it.
std::string explain(Gate const& gate, Outcome const& worst) {
  Measured const& m = worst.measured;
  if (!m.problem.empty()) return m.problem;
  if (gate.measure == GateMeasure::status && worst.kind == Outcome::failed && !m.run->reason.empty())
    return m.run->reason;
  if (worst.kind == Outcome::within_noise) return "the timings are too noisy to tell";
  if (worst.kind == Outcome::undecided) {
    return m.lower ? "the limit lies inside the interval"
                   : "no interval: fewer than three levels tell noise from order";
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

Verdict verdict_of(Gate const& gate, Outcome const& worst) {
  bool const passed = worst.kind == Outcome::passed;
  if (gate.expect_failure) return passed ? Verdict::unexpected_pass : Verdict::expected_failure;
  if (passed) return Verdict::passed;
  if (worst.kind == Outcome::within_noise) return Verdict::within_noise;
  return worst.kind == Outcome::undecided ? Verdict::undecided : Verdict::failed;
}

GateVerdict judge_gate(Gate const& gate, Results const& results, Baselines const& baselines,
                       std::string const& file) {
  GateVerdict verdict;
  verdict.name = gate.name;
  verdict.reason = gate.reason;
  std::vector<Measured> all = measure(gate, results, file);
  if (all.empty()) {
    verdict.verdict = Verdict::selects_nothing;
    verdict.measured = label_of(gate) + " of nothing";
    verdict.limit = show_limit(gate, std::nullopt);
    verdict.detail = why_empty(gate, results);
    return verdict;
  }
  for (Measured const& m : all) require_reachable(gate, m, file);
  std::vector<Measured> baseline;
  if (gate.limit.within) {
    baseline = measure_baseline(gate, baselines.at(gate.limit.baseline));
    std::vector<Measured> const missing = lost(all, baseline);
    all.insert(all.end(), missing.begin(), missing.end());
  }
  std::vector<Outcome> outcomes;
  for (Measured const& m : all) outcomes.push_back(judge_one(gate, m, baseline));
  auto const worst = std::max_element(outcomes.begin(), outcomes.end(),
                                      [](Outcome const& a, Outcome const& b) { return worse(b, a); });
  verdict.verdict = verdict_of(gate, *worst);
  verdict.measured = show_measured(gate, worst->measured);
  verdict.limit = show_limit(gate, worst->baseline);
  verdict.where = describe(worst->measured);
  verdict.detail = explain(gate, *worst);
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
    baselines.emplace(path, read_results(path));
  }
  return baselines;
}

std::vector<GateVerdict> judge(Gates const& gates, Results const& results, Baselines const& baselines) {
  std::vector<GateVerdict> verdicts;
  for (Gate const& gate : gates.gates) verdicts.push_back(judge_gate(gate, results, baselines, gates.file));
  return verdicts;
}

}  // namespace sphverify
