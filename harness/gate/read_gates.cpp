// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/gate/read_gates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "harness/gate/measure.hpp"
#include "harness/gate/select.hpp"
#include "harness/scene/choices.hpp"
#include "reports/run_statuses.hpp"

namespace sphverify {

namespace {

using WordList = std::vector<std::string>;

constexpr int most_particles = 100'000'000;

WordList const norm_words{"l1", "l2", "linf"};
WordList const order_verdict_words{"asymptotic", "pre-asymptotic", "floored", "diverging", "not-refined"};

/// The keys that go with a measure, beside those of every gate.
WordList keys_of(GateMeasure measure) {
  switch (measure) {
    case GateMeasure::order:
      return {"field", "region", "norm", "interval", "verdict"};
    case GateMeasure::error:
      return {"field", "region", "norm", "resolution", "relative"};
    case GateMeasure::skill:
      return {"field", "region", "norm", "resolution"};
    case GateMeasure::time_error:
      return {"resolution"};
    case GateMeasure::conservation:
      return {"quantity", "what", "resolution", "relative"};
    case GateMeasure::wall_flux:
      return {"wall", "resolution", "relative"};
    case GateMeasure::status:
      return {"resolution"};
    case GateMeasure::stability:
      return {"quantity", "resolution"};
    case GateMeasure::time_to_error:
      return {"field", "region", "norm", "target", "relative_to", "interval"};
    case GateMeasure::cost:
      return {"quantity", "resolution", "relative_to", "interval"};
  }
  return {};
}

/// A text that reports can show on one line.
std::string read_line(Node const& node) {
  std::string const text = node.string();
  bool const control = std::any_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) == 0x7F;
  });
  if (control || text.find_first_not_of(' ') == std::string::npos) {
    throw UserError(node.file(), node.key(), control ? "a line break or other control character" : "no text",
                    "a text of one line");
  }
  return text;
}

ParameterValue read_value(Node const& node) {
  if (node.is_string()) return node.string();
  if (!node.is_array()) return node.number();
  auto const elements = node.elements();
  if (elements.empty() || !elements.front().is_array()) return node.numbers();
  std::vector<std::vector<double>> table;
  for (Node const& row : elements) table.push_back(row.numbers());
  return table;
}

std::map<std::string, ParameterValue> read_parameter_match(Node const& node) {
  std::map<std::string, ParameterValue> parameters;
  for (auto const& [name, value] : node.members()) parameters[name] = read_value(value);
  return parameters;
}

CaseMatch read_case(Node const& node) {
  if (node.is_string()) return {node.string(), {}};
  node.require_keys({"id", "parameters"});
  CaseMatch match{node.at("id").string(), {}};
  if (auto const parameters = node.find("parameters")) match.parameters = read_parameter_match(*parameters);
  return match;
}

FormulationMatch read_formulation_match(Node const& node) {
  if (node.is_string()) return {node.string(), {}, {}, {}};
  node.require_keys({"id", "work", "conduction", "walls"});
  auto const partner = [&](char const* key) -> std::optional<std::string> {
    auto const found = node.find(key);
    if (!found) return std::nullopt;
    return found->is_null() ? "" : found->string();
  };
  FormulationMatch match{node.at("id").string(), partner("work"), partner("conduction"), {}};
  if (auto const walls = node.find("walls")) match.walls = WallChoice(walls->word(wall_words()));
  return match;
}

std::uint64_t read_seed(Node const& node) {
  return static_cast<std::uint64_t>(node.integer(0, std::numeric_limits<std::int64_t>::max()));
}

LayoutMatch read_layout(Node const& node) {
  if (node.is_string()) return {node.string(), {}, {}};
  node.require_keys({"id", "amplitude", "seed", "masses"});
  LayoutMatch match{node.at("id").string(), {}, {}};
  if (auto const amplitude = node.find("amplitude")) match.amplitude = amplitude->number();
  if (auto const seed = node.find("seed")) match.seed = read_seed(*seed);
  if (auto const masses = node.find("masses")) match.voronoi_masses = masses->word({"layout", "voronoi"}) == "voronoi";
  return match;
}

ViscosityChoice read_viscosity(Node const& node) {
  if (node.is_string()) {
    return {.riemann = node.word({"off", "riemann"}) == "riemann"};
  }
  node.require_keys({"alpha", "beta"});
  return {node.at("alpha").number(), node.at("beta").number()};
}

void read_discretisation(Node const& node, Select& select) {
  WordList known = discretisation_words();
  known.insert(known.end(), {"smoothing_ratio", "layout", "viscosity"});
  node.require_keys(known);
  for (auto const& [key, value] : node.members()) {
    for (Node const& one : value.one_or_many()) {
      if (key == "smoothing_ratio") {
        select.smoothing_ratios.push_back(one.positive_number());
      } else if (key == "layout") {
        select.layouts.push_back(read_layout(one));
      } else if (key == "viscosity") {
        select.viscosities.push_back(read_viscosity(one));
      } else {
        select.words[key].push_back(one.string());
      }
    }
  }
}

Select read_select(Node const& node) {
  node.require_keys(
      {"case", "parameters", "formulation", "discretisation", "resolution", "smoothing_exponent", "walls"});
  Select select;
  if (auto const cases = node.find("case")) {
    for (Node const& one : cases->one_or_many()) select.cases.push_back(read_case(one));
  }
  if (auto const parameters = node.find("parameters")) select.parameters = read_parameter_match(*parameters);
  if (auto const formulations = node.find("formulation")) {
    for (Node const& one : formulations->one_or_many()) select.formulations.push_back(read_formulation_match(one));
  }
  if (auto const d = node.find("discretisation")) read_discretisation(*d, select);
  if (auto const resolutions = node.find("resolution")) {
    for (Node const& one : resolutions->one_or_many())
      select.resolutions.push_back(static_cast<int>(one.integer(1, most_particles)));
  }
  if (auto const exponents = node.find("smoothing_exponent")) {
    for (Node const& one : exponents->one_or_many()) select.smoothing_exponents.push_back(one.number());
  }
  if (auto const walls = node.find("walls")) {
    for (FormulationMatch const& match : select.formulations) {
      if (match.walls) walls->complain("this key either here or in formulation");
    }
    select.walls.clear();
    for (Node const& one : walls->one_or_many()) select.walls.push_back(WallChoice(one.word(wall_words())));
  }
  return select;
}

void read_levels(Node const& node, Gate& gate) {
  if (node.is_string()) {
    gate.levels = node.word({"finest", "all"}) == "all" ? LevelChoice::all : LevelChoice::finest;
    return;
  }
  gate.levels = LevelChoice::one;
  gate.resolution = static_cast<int>(node.integer(1, most_particles));
}

/// What is measured, and of which runs.
void read_measure(Node const& node, Gate& gate) {
  if (is_of_series(gate.measure)) {
    char const* const expected = "nothing here: this measure is one of a whole ladder with all its seeds";
    Node const select = node.at("select");
    if (auto const resolution = select.find("resolution")) resolution->complain(expected);
    if (std::any_of(gate.select.layouts.begin(), gate.select.layouts.end(),
                    [](LayoutMatch const& layout) { return layout.seed.has_value(); })) {
      throw UserError(node.file(), gate.key + ".select.discretisation.layout", "a seed", expected);
    }
  }
  if (auto const field = node.find("field")) gate.field = field->string();
  if (auto const region = node.find("region")) gate.region = region->string();
  if (auto const norm = node.find("norm")) gate.norm = norm->word(norm_words);
  bool const whole_history =
      gate.measure == GateMeasure::status || gate.measure == GateMeasure::conservation ||
      gate.measure == GateMeasure::stability || gate.measure == GateMeasure::time_error;
  gate.levels = whole_history ? LevelChoice::all : LevelChoice::finest;
  if (auto const resolution = node.find("resolution")) read_levels(*resolution, gate);
  gate.relative = gate.measure == GateMeasure::conservation || gate.measure == GateMeasure::wall_flux;
  if (auto const relative = node.find("relative")) gate.relative = relative->boolean();
  if (auto const wall = node.find("wall")) gate.wall = static_cast<std::size_t>(wall->integer(0, 1000));
  auto const quantity = [&](WordList const& words, std::string const& by_default) {
    auto const found = node.find("quantity");
    gate.quantity = found ? found->word(words) : by_default;
  };
  if (gate.measure == GateMeasure::conservation) {
    quantity({"mass", "momentum", "energy"}, "energy");
    auto const what = node.find("what");
    gate.what = what ? what->word({"drift", "pair_drift", "wall_budget_defect"}) : "drift";
  }
  if (gate.measure == GateMeasure::stability) quantity(stability_quantities(), "spectral_abscissa");
  if (gate.measure == GateMeasure::cost) quantity(cost_quantities(), "seconds");
  if (auto const target = node.find("target")) gate.target = target->positive_number();
  if (gate.measure == GateMeasure::time_to_error || gate.measure == GateMeasure::cost) {
    auto const other = node.find("relative_to");
    if (!other) {
      throw UserError(node.file(), gate.key + ".relative_to", "nothing",
                      "another formulation: time and cost are gated as ratios only");
    }
    gate.relative_to = read_formulation_match(*other);
  }
  if (auto const interval = node.find("interval"))
    gate.interval_decides = interval->word({"decides", "ignore"}) == "decides";
  if (auto const verdict = node.find("verdict")) {
    gate.verdict_decides = verdict->word({"decides", "ignore"}) == "decides";
    if (node.find("equals")) verdict->complain("this key only beside a limit that is a number");
  }
}

CountRule read_count(Node const& node) {
  constexpr std::int64_t most = 1'000'000'000;
  auto const exactly = node.find("runs");
  auto const at_least = node.find("at_least");
  if (exactly && at_least) at_least->complain("'runs' or this key");
  CountRule rule;
  if (exactly) rule.exactly = static_cast<std::size_t>(exactly->integer(1, most));
  if (at_least) rule.at_least = static_cast<std::size_t>(at_least->integer(1, most));
  return rule;
}

Tolerance read_tolerance(Node const& node) {
  node.require_keys({"relative", "absolute"});
  Tolerance tolerance;
  auto const read = [&](char const* key) -> Number {
    auto const found = node.find(key);
    if (!found) return std::nullopt;
    if (found->number() < 0.0) found->complain("a number of 0 or more");
    return found->number();
  };
  tolerance.relative = read("relative");
  tolerance.absolute = read("absolute");
  if (!tolerance.relative && !tolerance.absolute) node.complain("relative, absolute or both");
  return tolerance;
}

void read_equals(Node const& node, Gate& gate) {
  if (gate.measure == GateMeasure::status) {
    gate.limit.equals_word = node.word(run_statuses);
  } else if (gate.measure == GateMeasure::order) {
    gate.limit.equals_word = node.word(order_verdict_words);
  } else {
    gate.limit.equals = node.number();
  }
}

/// A path in a document is meant from where the document stands.
std::string beside(std::string const& document, std::string const& path) {
  return (std::filesystem::path(document).parent_path() / path).lexically_normal().string();
}

void read_limit(Node const& node, std::optional<Node> const& common_baseline, Gate& gate) {
  auto const minimum = node.find("minimum");
  auto const maximum = node.find("maximum");
  auto const equals = node.find("equals");
  auto const within = node.find("within");
  if (int{minimum || maximum} + int{equals.has_value()} + int{within.has_value()} != 1) {
    throw UserError(node.file(), gate.key,
                    minimum || maximum || equals || within ? "limits of several kinds" : "no limit",
                    "minimum and/or maximum, or equals, or within");
  }
  if (gate.measure == GateMeasure::status && !equals) {
    (minimum ? *minimum : maximum ? *maximum : *within).complain("a status under equals instead");
  }
  if (minimum) gate.limit.minimum = minimum->number();
  if (maximum) gate.limit.maximum = maximum->number();
  if (minimum && maximum && minimum->number() > maximum->number()) {
    minimum->complain(fmt::format("at most the maximum, {}", maximum->number()));
  }
  if (equals) read_equals(*equals, gate);
  auto const baseline = node.find("baseline");
  if (!within) {
    if (baseline) baseline->complain("a baseline only beside within");
    return;
  }
  gate.limit.within = read_tolerance(*within);
  if (!baseline && !common_baseline) {
    throw UserError(node.file(), gate.key + ".baseline", "nothing", "a results file that within compares to");
  }
  gate.limit.baseline = beside(node.file(), read_line(baseline ? *baseline : *common_baseline));
}

GateMeasure measure_of(std::string const& word) {
  WordList const& words = gate_measure_words();
  return static_cast<GateMeasure>(std::find(words.begin(), words.end(), word) - words.begin());
}

/// Of a gate without a measure every measure's keys are known: what it has and no gate has is named before
/// what it lacks.
void require_gate_keys(Node const& node) {
  if (!node.is_object()) node.complain("an object");
  WordList known{"name", "select",   "measure",  "minimum", "maximum", "equals", "within",
              "runs", "at_least", "baseline", "expect",  "reason",  "note"};
  auto const found = node.find("measure");
  WordList const measures = found ? WordList{found->word(gate_measure_words())} : gate_measure_words();
  for (std::string const& word : measures) {
    for (std::string const& key : keys_of(measure_of(word))) {
      if (std::find(known.begin(), known.end(), key) == known.end()) known.push_back(key);
    }
  }
  node.require_keys(known);
}

Gate read_gate(Node const& node, std::optional<Node> const& common_baseline) {
  Gate gate;
  gate.key = node.key();
  require_gate_keys(node);
  gate.measure = measure_of(node.at("measure").string());
  gate.name = read_line(node.at("name"));
  if (auto const note = node.find("note")) note->string();
  gate.select = read_select(node.at("select"));
  gate.count = read_count(node);
  read_measure(node, gate);
  read_limit(node, common_baseline, gate);
  if (auto const expect = node.find("expect")) gate.expect_failure = expect->word({"pass", "fail"}) == "fail";
  auto const reason = node.find("reason");
  if (gate.expect_failure) {
    gate.reason = read_line(node.at("reason"));
  } else if (reason) {
    reason->complain("a reason only beside \"expect\": \"fail\"");
  }
  return gate;
}

}  // namespace

std::vector<std::string> const& gate_measure_words() {
  static WordList const words{"order",     "error",  "skill",     "time_error",    "conservation",
                           "wall_flux", "status", "stability", "time_to_error", "cost"};
  return words;
}

Gates read_gates(Node const& document) {
  document.require_document("sphverify-gates/1", {"schema", "name", "note", "baseline", "gates"});
  Gates all;
  all.file = document.file();
  all.name = std::filesystem::path(document.file()).stem().string();
  if (auto const name = document.find("name")) all.name = read_line(*name);
  if (auto const note = document.find("note")) note->string();
  auto const baseline = document.find("baseline");
  Node const list = document.at("gates");
  auto const nodes = list.elements();
  if (nodes.empty()) list.complain("at least one gate");
  for (Node const& node : nodes) {
    all.gates.push_back(read_gate(node, baseline));
    for (std::size_t k = 0; k + 1 < all.gates.size(); ++k) {
      if (all.gates[k].name == all.gates.back().name) node.at("name").complain("every name only once");
    }
  }
  return all;
}

}  // namespace sphverify
