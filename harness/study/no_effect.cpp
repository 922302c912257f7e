// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/no_effect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include "formulations/rate_operator.hpp"
#include "harness/study/expand.hpp"
#include "harness/study/wall_facts.hpp"

namespace sphverify {

namespace {

/// What a user sees of a study: different runs, and what is skipped with a reason.
struct Outcome {
  std::set<std::string> runs, skipped;
  std::set<std::string> used;  ///< key=value of choices that enter the numbers of a run
  bool operator==(Outcome const& other) const { return runs == other.runs && skipped == other.skipped; }
};

std::string text_of(std::string const& word) { return word; }
std::string text_of(double number) { return fmt::format("{}", number); }
std::string text_of(ViscosityChoice const& v) { return v.riemann ? "riemann" : fmt::format("{}|{}", v.alpha, v.beta); }
std::string text_of(std::optional<ViscosityChoice> const& v) { return v ? text_of(*v) : "auto"; }

/// A run by what enters its numbers.
std::string essence(Study const& study, RunSpec const& run, AnyProblem const& problem, std::size_t case_index,
                    std::set<std::string>& used) {
  Discretisation const& d = run.discretisation;
  FormulationChoice const& f = run.formulation;
  bool const walls = f.walls && has_walls(problem);
  bool const no_time = run.scene_case->info.kind == CaseKind::rates;
  // What an envelope drives is not what the study says.
  bool const drives_ratio = study.envelope && study.envelope->parameter == "smoothing_ratio";
  bool const drives_amplitude = study.envelope && study.envelope->parameter == "amplitude";
  auto const use = [&](bool is_used, char const* key, auto const& value) {
    if (is_used && !run.code) used.insert(std::string(key) + "=" + text_of(value));
  };
  bool const is_gas = moves(run.scene_case->info.kind);
  use(true, "density", d.density);
  use(!no_time, "integrator", d.integrator);
  use(is_gas, "viscosity", d.viscosity);
  use(is_gas, "smoothing", d.smoothing);
  bool const has_contacts = walls && (f.walls.are_terms() || has_free_wall(problem));
  SchemeInfo const* const scheme = find_scheme(f.id);
  bool const face_weighs = has_contacts && d.pair_weight == "kernel" && !(scheme && scheme->least_squares);
  use(true, "pair_weight", d.pair_weight);
  use(face_weighs, "face_weight", d.face_weight);
  use(has_contacts, "closure", d.closure);
  return fmt::format("{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}", case_index, run.resolution,
                     f.id, f.work, f.conduction, walls ? f.walls.word : "", d.kernel, d.density,
                     drives_ratio ? run.smoothing_ratio / d.smoothing_ratio : run.smoothing_ratio,
                     d.layout.id, drives_amplitude ? 0.0 : d.layout.amplitude, d.layout.seed,
                     d.layout.voronoi_masses, d.pair_weight, face_weighs ? d.face_weight : "", has_contacts ? d.closure : "", no_time ? "" : d.integrator,
                     d.smoothing, walls && has_free_wall(problem) ? d.wall_motion : "", text_of(d.viscosity));
}

Outcome outcome_of(Study study) {
  // Every level is as the first, but for what grows with the resolution.
  if (study.resolutions.size() > 2) study.resolutions.resize(2);
  Outcome outcome;
  Expansion const expansion = expand(study);
  for (std::size_t k = 0; k < study.cases.size(); ++k) {
    StudyCase const& one = study.cases[k];
    AnyProblem const problem = one.scene_case->problem(one.parameters);
    for (RunSpec const& run : expansion.runs) {
      if (run.scene_case == one.scene_case && run.parameters == one.parameters)
        outcome.runs.insert(essence(study, run, problem, k, outcome.used));
    }
  }
  for (Skipped const& s : expansion.skipped)
    outcome.skipped.insert(fmt::format("{}|{}|{}", s.case_id, s.formulation, s.reason));
  return outcome;
}

struct Asked {
  Study const& study;
  Study const& plain;  ///< the same without the choices of its document
  Node const& document;
  Outcome const outcome;
};

/// Of a list of values each must change something. A default may stand beside others, and what a run does
/// anyway may be said.
template <class Value>
void require_effect(Asked const& asked, char const* key, std::optional<Node> const& node,
                    std::vector<Value> Study::*values, std::string const& why_not) {
  std::vector<Value> const& given = asked.study.*values;
  if (!node || given == asked.plain.*values) return;
  auto const changes_nothing = [&](std::vector<Value> const& others) {
    Study other = asked.study;
    other.*values = others;
    return outcome_of(other) == asked.outcome;
  };
  std::string const expected = "what changes a run of this study: " + why_not;
  auto const nodes = node->one_or_many();
  std::vector<Value> const& defaults = asked.plain.*values;
  for (std::size_t k = given.size(); k-- > 0 && given.size() > 1;) {
    if (std::find(defaults.begin(), defaults.end(), given[k]) != defaults.end()) continue;
    std::vector<Value> others = given;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    if (changes_nothing(others)) nodes[k].complain(expected);
  }
  auto const is_used = [&](Value const& value) {
    return asked.outcome.used.contains(std::string(key) + "=" + text_of(value));
  };
  if (!std::all_of(given.begin(), given.end(), is_used) && changes_nothing(defaults))
    (nodes.size() == 1 ? nodes.front() : *node).complain(expected);
}

void require_formulations(Asked const& asked) {
  auto const nodes = asked.document.at("formulations").one_or_many();
  for (std::size_t k = nodes.size(); k-- > 0;) {
    Study other = asked.study;
    other.formulations.erase(other.formulations.begin() + static_cast<std::ptrdiff_t>(k));
    if (nodes.size() > 1 && outcome_of(other) == asked.outcome)
      nodes[k].complain("a formulation that is not among the others: its runs would be theirs");
  }
}

/// Measures that only some cases have.
void require_measures(Asked const& asked) {
  auto const measures = asked.document.find("measure");
  if (!measures) return;
  auto const runs = [&](auto const& has) {
    return std::any_of(asked.study.cases.begin(), asked.study.cases.end(),
                       [&](StudyCase const& one) { return has(one.scene_case->info.kind); });
  };
  bool const time_passes = runs([](CaseKind kind) { return kind != CaseKind::rates; });
  bool const conducts = runs([](CaseKind kind) { return kind == CaseKind::conduction; });
  bool const any_moves = runs(moves);
  for (Node const& node : measures->one_or_many()) {
    std::string const word = node.string();
    if (word == "second-law" && !conducts)
      node.complain("another measure: this one is of heat conduction at rest");
    if (word == "energy-routes" && !any_moves)
      node.complain("another measure: this one is of gases that move");
    bool const of_time =
        word == "stability" || word == "stable-step" || word == "spectrum" || word == "history";
    if (of_time && !time_passes) node.complain("another measure: no time passes in operator cases");
    bool const is_ours_alone = word == "stability" || word == "stable-step" || word == "spectrum" || word == "second-law" ||
                               word == "energy-routes";
    if (is_ours_alone && asked.study.codes.size() == asked.study.formulations.size())
      node.complain("another measure: this one is of formulations of ours, and every one here is another code");
  }
  if (auto const repeat = asked.document.find("repeat");
      repeat && asked.study.repeat.most > 1 && !asked.study.measure.contains(Measure::cost))
    repeat->complain("no repeats, or cost among the measures: nothing is timed");
}

}  // namespace

void require_effects(Study const& study, Node const& document) {
  auto const choice = [&](char const* key) {
    auto const d = document.find("discretisation");
    auto const node = d ? d->find(key) : std::nullopt;
    return node ? node : document.find(key);
  };
  Json bare = document.json();
  for (char const* key : {"discretisation", "smoothing_exponent", "closure", "integrator", "viscosity",
                          "smoothing", "wall_motion", "envelope"})
    bare.erase(key);
  bare["resolution"] = 1;  // the defaults go by the cases alone
  Study const plain = read_study(Node(bare, document.file()));
  Asked const asked{study, plain, document, outcome_of(study)};
  if (asked.outcome.runs.empty()) return;  // which is said with its reason
  char const* const no_wall_terms = "none has wall terms";
  require_effect(asked, "viscosity", choice("viscosity"), &Study::viscosities,
                 "particles at rest have no viscosity, and auto is one or none by the case");
  require_effect(asked, "smoothing", choice("smoothing"), &Study::smoothings,
                 "particles at rest have one smoothing length");
  require_effect(asked, "wall_motion", choice("wall_motion"), &Study::wall_motions,
                 "in none does a wall go with the gas");
  require_effect(asked, "integrator", choice("integrator"), &Study::integrators,
                 "each takes one that suits it, and without time none");
  require_effect(asked, "density", choice("density"), &Study::densities,
                 "given is for particles at rest, continuity for "
                 "those that move");
  require_effect(asked, "face_weight", choice("face_weight"), &Study::face_weights,
                 "none has wall terms with the kernel's pair weights");
  require_effect(asked, "closure", choice("closure"), &Study::closures, no_wall_terms);
  require_effect(asked, "smoothing_exponent", document.find("smoothing_exponent"),
                 &Study::smoothing_exponents,
                 "at the first resolution, here the only one, h/dx is smoothing_ratio");
  require_effect(asked, "smoothing_ratio", choice("smoothing_ratio"), &Study::smoothing_ratios,
                 "the envelope drives it");
  require_formulations(asked);
  require_measures(asked);
}

}  // namespace sphverify
