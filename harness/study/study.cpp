// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "harness/scene/choices.hpp"
#include "harness/study/available_memory.hpp"
#include "harness/study/memory.hpp"
#include "harness/study/read_case.hpp"
#include "harness/study/read_envelope.hpp"
#include "harness/study/read_formulation.hpp"
#include "harness/study/read_layout.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

std::vector<MeasureWord> const& measure_words() {
  static std::vector<MeasureWord> const words{
      {"error", Measure::error, "norms of the error by field and region, and the flux through each wall"},
      {"conservation", Measure::conservation,
       "budgets of mass, momentum and energy: drift, exchange through walls, wall budget defect"},
      {"cost", Measure::cost,
       "wall and processor time (minimum and median of the repeats), counted work, memory"},
      {"stability", Measure::stability, "eigenvalues of the linearised rate: abscissa, radius, stable step"},
      {"stable-step", Measure::stable_step,
       "largest stable steps of explicit methods, by bisection on their own steps"},
      {"second-law", Measure::second_law, "overshoots, heat from cold to hot, entropy production"},
      {"profile", Measure::profile, "computed and exact fields at the final time (stored)"},
      {"history", Measure::history, "budgets over time (stored)"},
      {"spectrum", Measure::spectrum, "all eigenvalues of the linearised rate (stored)"},
      {"energy-routes", Measure::energy_routes,
       "how far a moving gas parts from the same run with the other work form (total against internal "
       "energy)"}};
  return words;
}

namespace {

constexpr int most_repeats = 1000;

std::vector<std::string> measure_names() {
  std::vector<std::string> names;
  for (MeasureWord const& word : measure_words()) names.emplace_back(word.word);
  return names;
}

/// A key of the discretisation with its default; the rarer ones may also stand at the top of the document.
std::optional<Node> find_choice(Node const& document, std::string const& key) {
  if (auto const discretisation = document.find("discretisation")) {
    if (auto const node = discretisation->find(key)) return node;
  }
  return document.find(key);
}

std::vector<std::string> read_words(std::optional<Node> const& node, std::vector<std::string> const& allowed,
                                    std::vector<std::string> const& default_words) {
  if (!node) return default_words;
  std::vector<std::string> words;
  for (Node const& element : node->one_or_many()) {
    std::string const word = element.word(allowed);
    if (std::find(words.begin(), words.end(), word) != words.end()) element.complain("every value only once");
    words.push_back(word);
  }
  return words;
}

template <class Read>
std::vector<double> read_numbers(std::optional<Node> const& node, double default_value, Read const& read) {
  if (!node) return {default_value};
  std::vector<double> values;
  for (Node const& element : node->one_or_many()) {
    double const value = read(element);
    if (std::find(values.begin(), values.end(), value) != values.end())
      element.complain("every value only once");
    values.push_back(value);
  }
  return values;
}

/// What particles at rest and particles that move take by default, where the study has either.
std::vector<std::string> defaults(std::vector<StudyCase> const& cases, std::string const& at_rest,
                                  std::string const& in_motion) {
  std::vector<std::string> words;
  auto const any = [&](bool moving) {
    return std::any_of(cases.begin(), cases.end(),
                       [&](StudyCase const& one) { return moves(one.scene_case->info.kind) == moving; });
  };
  if (any(false)) words.push_back(at_rest);
  if (any(true)) words.push_back(in_motion);
  return words;
}

std::optional<ViscosityChoice> read_viscosity(Node const& node) {
  if (node.is_string()) {
    std::string const word = node.word({"auto", "off", "riemann"});
    if (word == "auto") return std::nullopt;
    return ViscosityChoice{.riemann = word == "riemann"};
  }
  node.require_keys({"alpha", "beta"});
  auto const coefficient = [&](char const* key) { return node.at(key).number_between(0.0, 100.0); };
  return ViscosityChoice{coefficient("alpha"), coefficient("beta")};
}

/// A number of repeats, or when there are enough.
RepeatRule read_repeat(Node const& node) {
  if (!node.is_object()) {
    if (!node.json().is_number()) node.complain("a whole number from 1 to 1000, or an object of rules");
    int const count = static_cast<int>(node.integer(1, most_repeats));
    return {.most = count, .least = count, .spread = 0.0, .seconds = 0.0};
  }
  node.require_keys({"most", "least", "spread", "seconds"});
  RepeatRule rule{.most = 25, .least = 6, .spread = 0.02, .seconds = 2.0};
  if (auto const most = node.find("most")) rule.most = static_cast<int>(most->integer(1, most_repeats));
  auto const least = node.find("least");
  if (least) rule.least = static_cast<int>(least->integer(1, most_repeats));
  // What is not named gives way to what is.
  if (!least) rule.least = std::min(rule.least, rule.most);
  if (!node.find("most")) rule.most = std::max(rule.least, rule.most);
  if (rule.least > rule.most) least->complain(fmt::format("at most {}, which is `most`", rule.most));
  if (auto const spread = node.find("spread")) {
    rule.spread = spread->positive_number();
    if (rule.spread > 1.0) spread->complain("a part of the median, at most 1");
  }
  if (auto const seconds = node.find("seconds")) rule.seconds = seconds->positive_number();
  return rule;
}

std::vector<std::size_t> read_chosen_runs(Node const& node) {
  if (!node.is_array()) node.complain("a list of runs, counted from 0");
  std::vector<std::size_t> runs;
  for (Node const& run : node.elements()) {
    auto const number = static_cast<std::size_t>(run.integer(0, 1'000'000'000));
    if (!runs.empty() && number <= runs.back()) run.complain("ascending numbers");
    runs.push_back(number);
  }
  return runs;
}

/// All combinations are held in memory, those that make no sense among them.
void require_few(Study const& study, Node const& document) {
  constexpr double most = 200'000.0;
  double combinations = 1.0;
  for (std::size_t const choices :
       {study.cases.size(), study.formulations.size(), study.kernels.size(), study.pair_weights.size(), study.densities.size(),
        study.face_weights.size(), study.closures.size(), study.integrators.size(), study.smoothings.size(),
        study.wall_motions.size(), study.viscosities.size(), study.smoothing_ratios.size(), study.layouts.size(),
        study.smoothing_exponents.size(), study.resolutions.size()})
    combinations *= static_cast<double>(choices);
  if (combinations > most)
    throw UserError(document.file(), "", fmt::format("lists of {:.3g} combinations", combinations),
                    fmt::format("at most {:.0f}: several studies, which `compare` takes together", most));
}

/// Whether a formulation is a code that the study runs.
bool names_external(Node const& node) {
  if (node.is_string()) {
    if (is_external(node.string())) node.complain(R"({"id": "external/NAME", "command": [...]}: what is to be run)");
    return false;
  }
  auto const id = node.is_object() ? node.find("id") : std::nullopt;
  return id && id->is_string() && is_external(id->string());
}

Json to_json(RepeatRule const& rule) {
  if (rule.spread == 0.0) return rule.most;
  return {{"most", rule.most}, {"least", rule.least}, {"spread", rule.spread}, {"seconds", rule.seconds}};
}

}  // namespace

std::shared_ptr<ExternalCode const> Study::code_of(std::string const& formulation) const {
  for (auto const& code : codes) {
    if (code->id == formulation) return code;
  }
  return nullptr;
}

Study read_study(Node const& document) {
  document.require_document("sphverify-study/1",
                            {"schema", "name", "cases", "formulations", "discretisation", "resolution",
                             "smoothing_exponent", "measure", "threads", "repeat", "closure", "integrator",
                             "viscosity", "smoothing", "wall_motion", "time_budget", "envelope",
                             "plugins", "runs"});
  // What is not known is named before what is missing.
  if (auto const d = document.find("discretisation")) {
    d->require_keys({"kernel", "pair_weight", "density", "smoothing_ratio", "layout", "face_weight", "closure", "integrator",
                     "viscosity", "smoothing", "wall_motion"});
  }
  Study study;
  study.name = document.at("name").string();
  for (Node const& node : document.at("cases").one_or_many()) {
    StudyCase const one = read_case(node);
    for (StudyCase const& known : study.cases) {
      if (known.scene_case == one.scene_case && known.parameters == one.parameters) {
        node.complain("every case with its parameters only once");
      }
    }
    study.cases.push_back(one);
  }
  if (auto const plugins = document.find("plugins")) {
    for (Node const& library : plugins->one_or_many()) load_plugin_named(library, study.plugins);
  }
  for (Node const& node : document.at("formulations").one_or_many()) {
    FormulationChoice f;
    if (names_external(node)) {
      study.codes.push_back(std::make_shared<ExternalCode const>(read_external_code(node)));
      f.id = study.codes.back()->id;
    } else {
      f = read_study_formulation(node, study.plugins);
    }
    if (std::find(study.formulations.begin(), study.formulations.end(), f) != study.formulations.end()) {
      node.complain("every formulation only once");
    }
    study.formulations.push_back(f);
  }

  if (auto const d = document.find("discretisation")) {
    for (char const* key : {"closure", "integrator", "viscosity", "smoothing", "wall_motion"}) {
      if (d->find(key) && document.find(key)) {
        document.at(key).complain("this key either here or in discretisation");
      }
    }
  }
  study.kernels = read_words(find_choice(document, "kernel"), kernel_words(), {kernel_words().front()});
  study.pair_weights = read_words(find_choice(document, "pair_weight"), pair_weight_words.all(), {"kernel"});
  study.densities = read_words(find_choice(document, "density"), density_words.all(),
                               defaults(study.cases, "given", "continuity"));
  study.face_weights = read_words(find_choice(document, "face_weight"), face_weight_words.all(), {"exact"});
  study.closures = read_words(find_choice(document, "closure"), closure_words.all(), {"interpolated"});
  study.integrators =
      read_words(find_choice(document, "integrator"),
                 {"bdf", "implicit-runge-kutta", "runge-kutta", "runge-kutta-chebyshev", "leapfrog", "auto"},
                 defaults(study.cases, "bdf", "auto"));
  study.smoothings = read_words(find_choice(document, "smoothing"), {"uniform", "adaptive"}, {"uniform"});
  study.wall_motions =
      read_words(find_choice(document, "wall_motion"), wall_motion_words.all(), {"velocity"});
  if (auto const viscosities = find_choice(document, "viscosity")) {
    for (Node const& node : viscosities->one_or_many()) {
      auto const viscosity = read_viscosity(node);
      if (std::find(study.viscosities.begin(), study.viscosities.end(), viscosity) !=
          study.viscosities.end()) {
        node.complain("every value only once");
      }
      study.viscosities.push_back(viscosity);
    }
  } else {
    study.viscosities = {std::nullopt};
  }
  study.smoothing_ratios = read_numbers(find_choice(document, "smoothing_ratio"), 1.2,
                                        [](Node const& node) { return read_smoothing_ratio(node); });
  if (auto const layouts = find_choice(document, "layout")) {
    for (Node const& node : layouts->one_or_many()) {
      for (LayoutChoice const& layout : read_layout(node)) {
        // Twice the same particles would be taken for replicates.
        if (std::find(study.layouts.begin(), study.layouts.end(), layout) != study.layouts.end()) {
          node.complain("every layout and seed only once");
        }
        study.layouts.push_back(layout);
      }
    }
  } else {
    study.layouts = {{"lattice"}};
  }
  study.smoothing_exponents = read_numbers(document.find("smoothing_exponent"), 0.0,
                                           [](Node const& node) { return node.number_between(-1.0, 1.0); });

  for (Node const& node : document.at("resolution").one_or_many()) {
    study.resolutions.push_back(static_cast<int>(node.integer(1, 100'000'000)));
    if (study.resolutions.size() > 1 &&
        study.resolutions.back() <= study.resolutions[study.resolutions.size() - 2]) {
      node.complain("ascending resolutions");
    }
  }
  auto const measures = document.find("measure");
  if (!measures) study.measure = {Measure::error, Measure::conservation, Measure::cost};
  if (measures) {
    for (Node const& node : measures->one_or_many()) {
      std::string const word = node.word(measure_names());
      for (MeasureWord const& known : measure_words()) {
        if (known.word != word) continue;
        if (study.measure.contains(known.measure)) node.complain("every measure only once");
        study.measure.insert(known.measure);
      }
    }
  }
  if (auto const node = document.find("threads")) study.threads = static_cast<int>(node->integer(1, 1024));
  if (auto const node = document.find("repeat")) study.repeat = read_repeat(*node);
  study.time_budget = 300.0;
  if (auto const node = document.find("time_budget")) study.time_budget = node->positive_number();
  if (auto const node = document.find("envelope")) study.envelope = read_envelope(*node, study);
  if (auto const node = document.find("runs")) study.runs = read_chosen_runs(*node);
  require_few(study, document);
  return study;
}

void require_memory(Study const& study, Node const& document) {
  double const memory = available_memory();
  int const finest = study.resolutions.back();
  double const refinement = static_cast<double>(finest) / study.resolutions.front();
  double ratio = 0.0;
  std::vector<double> nominals = study.smoothing_ratios;
  if (study.envelope && study.envelope->parameter == "smoothing_ratio")
    nominals = {study.envelope->from, study.envelope->to};
  for (double const nominal : nominals) {
    for (double const exponent : study.smoothing_exponents) {
      ratio = std::max(ratio, nominal * std::pow(refinement, exponent));
    }
  }
  double support = 0.0;
  for (std::string const& id : study.kernels)
    support = std::max(support, kernel(id, 1).support_ratio() * ratio);
  for (StudyCase const& one : study.cases) {
    AnyProblem const problem = one.scene_case->problem(one.parameters);
    // What takes least of those that are asked for: the others may be skipped.
    auto const asks = [&](char const* word) {
      return std::find(study.integrators.begin(), study.integrators.end(), word) != study.integrators.end();
    };
    bool const leapfrog = asks("leapfrog") || (asks("auto") && one.scene_case->info.discontinuous);
    char const* const integrator = leapfrog ? "leapfrog" : "runge-kutta";
    for (LayoutChoice const& layout : study.layouts) {
      if (!why_not(problem, layout).empty()) continue;  // skipped with a reason
      double weights = std::numeric_limits<double>::infinity();
      for (FormulationChoice const& formulation : study.formulations)
        weights = std::min(weights, bytes_of_weights(formulation, problem, layout, finest, support));
      double const bytes = estimated_bytes(one.scene_case->info.kind, integrator, problem, layout, finest, support) + weights;
      if (bytes <= memory) continue;
      throw UserError(
          document.file(), "resolution",
          fmt::format("{}, which on {} is {:.3g} particles and takes about {:.3g} GB", finest,
                      one.scene_case->info.id, estimated_particles(problem, layout, finest), 1e-9 * bytes),
          fmt::format("what fits into the {:.3g} GB that this process may have", 1e-9 * memory));
    }
  }
}

Json to_json(Study const& study) {
  Json json = {{"schema", "sphverify-study/1"},
               {"name", study.name},
               {"cases", Json::array()},
               {"formulations", Json::array()}};
  for (StudyCase const& one : study.cases) {
    json["cases"].push_back(
        {{"id", one.scene_case->info.id}, {"parameters", parameters_json(one.parameters.all())}});
  }
  if (!study.plugins.empty()) json["plugins"] = study.plugins;
  for (FormulationChoice const& f : study.formulations) {
    ExternalCode const* const code = study.code_of(f.id).get();
    json["formulations"].push_back(code ? to_json(*code) : to_json(f));
  }
  Json layouts = Json::array();
  for (LayoutChoice const& layout : study.layouts) layouts.push_back(to_json(layout));
  json["discretisation"] = {{"kernel", study.kernels},
                            {"pair_weight", study.pair_weights},
                            {"density", study.densities},
                            {"smoothing_ratio", study.smoothing_ratios},
                            {"layout", layouts},
                            {"face_weight", study.face_weights},
                            {"closure", study.closures},
                            {"integrator", study.integrators},
                            {"smoothing", study.smoothings},
                            {"wall_motion", study.wall_motions},
                            {"viscosity", Json::array()}};
  for (auto const& viscosity : study.viscosities) {
    json["discretisation"]["viscosity"].push_back(viscosity ? to_json(*viscosity) : Json("auto"));
  }
  json["resolution"] = study.resolutions;
  json["smoothing_exponent"] = study.smoothing_exponents;
  json["measure"] = Json::array();
  for (MeasureWord const& word : measure_words()) {
    if (study.measure.contains(word.measure)) json["measure"].push_back(word.word);
  }
  json["threads"] = study.threads;
  json["repeat"] = to_json(study.repeat);
  json["time_budget"] = study.time_budget;
  if (study.envelope) {
    json["envelope"] = {{"parameter", study.envelope->parameter},
                        {"from", study.envelope->from},
                        {"to", study.envelope->to},
                        {"scale", study.envelope->logarithmic ? "logarithmic" : "linear"},
                        {"bisections", study.envelope->bisections}};
  }
  if (study.runs) json["runs"] = *study.runs;
  return json;
}

}  // namespace sphverify
