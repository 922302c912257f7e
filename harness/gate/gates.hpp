// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/results.hpp"

namespace sphverify {

/// What a gate measures.
enum class GateMeasure {
  order,
  error,
  skill,
  time_error,
  conservation,
  wall_flux,
  status,
  stability,
  time_to_error,
  cost
};

/// Whether a measure is one of a whole ladder.
bool is_of_series(GateMeasure measure);

/// Matches the formulations that have all that is named.
struct FormulationMatch {
  std::string id;                               ///< empty: any
  std::optional<std::string> work, conduction;  ///< an empty one matches those without a partner
  std::optional<WallChoice> walls;
};

struct CaseMatch {
  std::string id;
  std::map<std::string, ParameterValue> parameters;  ///< those named
};

struct LayoutMatch {
  std::string id;
  Number amplitude;
  std::optional<std::uint64_t> seed;
  std::optional<bool> voronoi_masses{};
};

/// Which runs and series a gate is about. A list holds alternatives, an empty one matches all.
struct Select {
  std::vector<CaseMatch> cases;
  std::map<std::string, ParameterValue> parameters;
  std::vector<FormulationMatch> formulations;
  std::map<std::string, std::vector<std::string>> words;  ///< of the discretisation, by its keys
  std::vector<double> smoothing_ratios;
  std::vector<LayoutMatch> layouts;
  std::vector<ViscosityChoice> viscosities;
  std::vector<int> resolutions;
  std::vector<double> smoothing_exponents;
  std::vector<WallChoice> walls{true};
};

/// How many runs (or series) a gate must look at. Where neither is given, every entry of a list in `select`
/// must match something.
struct CountRule {
  std::optional<std::size_t> exactly, at_least;
};

/// Which levels of a ladder a gate on runs takes.
enum class LevelChoice { finest, all, one };

/// By how much a number may differ from the baseline's: by the larger of the two that are given. Where only
/// `relative` is and the baseline is no more than rounding, by what rounding explains.
struct Tolerance {
  Number relative, absolute;
};

/// What must hold of the measured number or word.
struct Limit {
  Number minimum, maximum;
  Number equals;
  std::string equals_word;
  std::optional<Tolerance> within;
  std::string baseline;  ///< path of the results that `within` compares to
};

struct Gate {
  std::string name;
  std::string key;  ///< where it stands in the document, for complaints
  Select select;
  CountRule count;
  GateMeasure measure = GateMeasure::status;
  std::string field;  ///< empty: the one that the case is about
  std::string region = "all", norm = "l2";
  std::string quantity;  ///< of a budget, a spectrum or a cost
  std::string what;      ///< of a budget
  std::optional<std::size_t> wall;
  LevelChoice levels = LevelChoice::finest;
  int resolution = 0;     ///< of LevelChoice::one
  bool relative = false;  ///< to the scale that goes with the measure
  double target = 0.01;   ///< of time_to_error, relative to the exact field's norm
  FormulationMatch relative_to;
  bool interval_decides = true;
  bool verdict_decides = true;  ///< no number counts as the order of a ladder that is floored or diverges
  Limit limit;
  bool expect_failure = false;
  std::string reason;  ///< why a failure is expected
};

/// The gates document, sphverify-gates/1.
struct Gates {
  std::string file, name;
  std::vector<Gate> gates;
};

/// One number or word that a gate looks at, and whose it is.
struct Measured {
  RunRecord const* run = nullptr;  ///< null for a measure of a whole series
  Series const* series = nullptr;
  Number value;
  Number lower, upper;  ///< interval of the value, where it has one
  /// Of a ratio of times: the ends if the noise were as kind to the gate as the interval allows. Only a gate
  /// that does not hold even then fails by more than noise.
  Number kindest_lower, kindest_upper;
  Number round_off;     ///< at most so much of it is rounding, where that is known
  std::string word;     ///< of a measure that is a word
  std::string remark;   ///< of an order: why its verdict is what it is
  std::string problem;  ///< why there is no number; empty where there is one
};

enum class Verdict {
  passed,
  within_noise,
  failed,
  undecided,
  expected_failure,
  unexpected_pass,
  selects_nothing
};

std::string_view word(Verdict verdict);

/// Whether a verdict lets the whole pass.
constexpr bool holds(Verdict verdict) {
  return verdict == Verdict::passed || verdict == Verdict::within_noise ||
         verdict == Verdict::expected_failure;
}

/// A gate did not hold: exit status 1. What there is to say has been written.
struct GateFailed {};

/// What came of a gate, in words; of several runs or series the worst is shown.
struct GateVerdict {
  std::string name;
  Verdict verdict = Verdict::failed;
  std::string measured;  ///< with interval or unit
  std::string limit;
  std::string where;   ///< whose number that is
  std::string detail;  ///< why, where there is more to say; one line
  std::string reason;  ///< of an expected failure
  std::size_t looked_at = 0, failing = 0;
};

}  // namespace sphverify
