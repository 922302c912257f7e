#include "harness/gate/select.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <set>

#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

struct WordKey {
  char const* key;
  std::string Discretisation::*member;
};
WordKey const word_keys[] = {
    {"kernel", &Discretisation::kernel},           {"density", &Discretisation::density},
    {"face_weight", &Discretisation::face_weight}, {"closure", &Discretisation::closure},
    {"integrator", &Discretisation::integrator},   {"smoothing", &Discretisation::smoothing},
    {"wall_motion", &Discretisation::wall_motion}};

template <class T>
bool is_one_of(T const& value, std::vector<T> const& allowed) {
  return allowed.empty() || std::find(allowed.begin(), allowed.end(), value) != allowed.end();
}

template <class Match, class Test>
bool any(std::vector<Match> const& alternatives, Test const& test) {
  return alternatives.empty() || std::any_of(alternatives.begin(), alternatives.end(), test);
}

bool holds_all(std::map<std::string, ParameterValue> const& named,
               std::map<std::string, ParameterValue> const& values) {
  return std::all_of(named.begin(), named.end(), [&](auto const& entry) {
    auto const found = values.find(entry.first);
    return found != values.end() && found->second == entry.second;
  });
}

bool matches(LayoutMatch const& match, LayoutChoice const& layout) {
  return match.id == layout.id && match.amplitude.value_or(layout.amplitude) == layout.amplitude &&
         match.seed.value_or(layout.seed) == layout.seed;
}

/// One key of a selection: whether it is met, and what a run or series has there.
template <class Subject>
struct Criterion {
  std::string key;
  std::function<bool(Subject const&)> met;
  std::function<std::string(Subject const&)> found;
};

template <class Subject>
std::vector<Criterion<Subject>> criteria(Select const& select) {
  std::vector<Criterion<Subject>> all;
  all.push_back({"case",
                 [&](Subject const& s) {
                   return any(select.cases, [&](CaseMatch const& match) { return match.id == s.case_id; });
                 },
                 [](Subject const& s) { return s.case_id; }});
  all.push_back({"parameters",
                 [&](Subject const& s) {
                   return holds_all(select.parameters, s.parameters) &&
                          any(select.cases, [&](CaseMatch const& match) {
                            return match.id == s.case_id && holds_all(match.parameters, s.parameters);
                          });
                 },
                 [](Subject const& s) { return s.case_id + " " + parameters_json(s.parameters).dump(); }});
  all.push_back({"formulation",
                 [&](Subject const& s) {
                   return any(select.formulations,
                              [&](FormulationMatch const& match) { return matches(match, s.formulation); });
                 },
                 [](Subject const& s) { return s.label; }});
  all.push_back({"walls",
                 [&](Subject const& s) {
                   bool const named = std::any_of(
                       select.formulations.begin(), select.formulations.end(),
                       [&](FormulationMatch const& m) { return m.walls && matches(m, s.formulation); });
                   return named || is_one_of(s.formulation.walls, select.walls);
                 },
                 [](Subject const& s) { return s.formulation.walls ? "on" : "off"; }});
  for (WordKey const& word : word_keys) {
    auto const named = select.words.find(word.key);
    if (named == select.words.end()) continue;
    all.push_back({std::string("discretisation.") + word.key,
                   [&word, &allowed = named->second](Subject const& s) {
                     return is_one_of(s.discretisation.*word.member, allowed);
                   },
                   [&word](Subject const& s) { return s.discretisation.*word.member; }});
  }
  all.push_back(
      {"discretisation.smoothing_ratio",
       [&](Subject const& s) { return is_one_of(s.discretisation.smoothing_ratio, select.smoothing_ratios); },
       [](Subject const& s) { return fmt::format("{}", s.discretisation.smoothing_ratio); }});
  all.push_back({"discretisation.layout",
                 [&](Subject const& s) {
                   return any(select.layouts, [&](LayoutMatch const& match) {
                     return matches(match, s.discretisation.layout);
                   });
                 },
                 [](Subject const& s) { return to_json(s.discretisation.layout).dump(); }});
  all.push_back({"discretisation.viscosity",
                 [&](Subject const& s) { return is_one_of(s.discretisation.viscosity, select.viscosities); },
                 [](Subject const& s) { return to_json(s.discretisation.viscosity).dump(); }});
  all.push_back(
      {"smoothing_exponent",
       [&](Subject const& s) { return is_one_of(s.smoothing_exponent, select.smoothing_exponents); },
       [](Subject const& s) { return fmt::format("{}", s.smoothing_exponent); }});
  return all;
}

std::vector<Criterion<RunRecord>> run_criteria(Select const& select) {
  auto all = criteria<RunRecord>(select);
  all.push_back({"resolution",
                 [&](RunRecord const& run) { return is_one_of(run.resolution, select.resolutions); },
                 [](RunRecord const& run) { return fmt::format("{}", run.resolution); }});
  return all;
}

template <class Subject>
bool meets(std::vector<Criterion<Subject>> const& all, Subject const& subject) {
  return std::all_of(all.begin(), all.end(), [&](auto const& criterion) { return criterion.met(subject); });
}

std::vector<RunRecord const*> runs_that_meet(Criterion<RunRecord> const& criterion,
                                             std::vector<RunRecord const*> runs) {
  std::erase_if(runs, [&](RunRecord const* run) { return !criterion.met(*run); });
  return runs;
}

/// What runs have where a key stands, each value once.
std::string values_of(Criterion<RunRecord> const& criterion, std::vector<RunRecord const*> const& runs) {
  constexpr std::size_t most_shown = 8;
  std::set<std::string> found;
  for (RunRecord const* run : runs) found.insert(criterion.found(*run));
  std::vector<std::string> shown(found.begin(), found.end());
  if (shown.size() > most_shown) {
    shown.resize(most_shown);
    shown.emplace_back("...");
  }
  return fmt::format("{}", fmt::join(shown, ", "));
}

}  // namespace

std::vector<std::string> const& discretisation_words() {
  static std::vector<std::string> const words = [] {
    std::vector<std::string> keys;
    for (WordKey const& word : word_keys) keys.emplace_back(word.key);
    return keys;
  }();
  return words;
}

bool matches(FormulationMatch const& match, FormulationChoice const& formulation) {
  return (match.id.empty() || match.id == formulation.id) &&
         match.work.value_or(formulation.work) == formulation.work &&
         match.conduction.value_or(formulation.conduction) == formulation.conduction &&
         match.walls.value_or(formulation.walls) == formulation.walls;
}

bool matches(Select const& select, RunRecord const& run) { return meets(run_criteria(select), run); }

bool matches(Select const& select, Series const& series) { return meets(criteria<Series>(select), series); }

std::string why_empty(Gate const& gate, Results const& results) {
  if (results.runs.empty()) return "the results hold no run";
  std::vector<Criterion<RunRecord>> const all = run_criteria(gate.select);
  std::vector<RunRecord const*> runs;
  for (RunRecord const& run : results.runs) runs.push_back(&run);
  for (auto const& criterion : all) {
    if (runs_that_meet(criterion, runs).empty())
      return fmt::format("no run matches '{}'; the runs have {}", criterion.key, values_of(criterion, runs));
  }
  std::vector<std::string> narrowing;  // keys that leave some of the runs out
  for (auto const& criterion : all) {
    std::vector<RunRecord const*> const left = runs_that_meet(criterion, runs);
    if (left.empty()) {
      return fmt::format("no run that matches '{}' also matches '{}'; those runs have {}",
                         fmt::join(narrowing, "' and '"), criterion.key, values_of(criterion, runs));
    }
    if (left.size() < runs.size()) narrowing.push_back(criterion.key);
    runs = left;
  }
  FormulationMatch const& reference = gate.relative_to;
  if (!reference.id.empty()) {
    std::erase_if(runs, [&](RunRecord const* run) { return matches(reference, run->formulation); });
    if (runs.empty())
      return fmt::format("it selects runs of {} alone, which 'relative_to' names: nothing is left to compare",
                         reference.id);
  }
  if (gate.levels == LevelChoice::one) {
    return fmt::format("no run that it selects has 'resolution' {}; they have {}", gate.resolution,
                       values_of(all.back(), runs));
  }
  return "the runs that it selects belong to no ladder";
}

}  // namespace sphverify
