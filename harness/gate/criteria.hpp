// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "harness/gate/gates.hpp"
#include "harness/gate/select.hpp"
#include "reports/json/results_json.hpp"

// A selection as criteria, one for each key: for what matches and for why nothing does.
namespace sphverify {

struct WordKey {
  char const* key;
  std::string Discretisation::*member;
};
inline WordKey const word_keys[] = {
    {"kernel", &Discretisation::kernel},           {"density", &Discretisation::density},
    {"face_weight", &Discretisation::face_weight}, {"closure", &Discretisation::closure},
    {"integrator", &Discretisation::integrator},   {"smoothing", &Discretisation::smoothing},
    {"wall_motion", &Discretisation::wall_motion}, {"pair_weight", &Discretisation::pair_weight}};

template <class T>
bool is_one_of(T const& value, std::vector<T> const& allowed) {
  return allowed.empty() || std::find(allowed.begin(), allowed.end(), value) != allowed.end();
}

template <class Match, class Test>
bool any(std::vector<Match> const& alternatives, Test const& test) {
  return alternatives.empty() || std::any_of(alternatives.begin(), alternatives.end(), test);
}

inline bool holds_all(std::map<std::string, ParameterValue> const& named,
                      std::map<std::string, ParameterValue> const& values) {
  return std::all_of(named.begin(), named.end(), [&](auto const& entry) {
    auto const found = values.find(entry.first);
    return found != values.end() && found->second == entry.second;
  });
}

inline bool matches(LayoutMatch const& match, LayoutChoice const& layout) {
  return match.id == layout.id && match.amplitude.value_or(layout.amplitude) == layout.amplitude &&
         match.seed.value_or(layout.seed) == layout.seed &&
         match.voronoi_masses.value_or(layout.voronoi_masses) == layout.voronoi_masses;
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
                 [](Subject const& s) { return s.formulation.walls.word; }});
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

inline std::vector<Criterion<RunRecord>> run_criteria(Select const& select) {
  auto all = criteria<RunRecord>(select);
  all.push_back({"resolution",
                 [&](RunRecord const& run) { return is_one_of(run.resolution, select.resolutions); },
                 [](RunRecord const& run) { return fmt::format("{}", run.resolution); }});
  return all;
}

}  // namespace sphverify
