// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/gate/select.hpp"

#include <algorithm>

#include "harness/gate/criteria.hpp"

namespace sphverify {

namespace {

template <class Subject>
bool meets(std::vector<Criterion<Subject>> const& all, Subject const& subject) {
  return std::all_of(all.begin(), all.end(), [&](auto const& criterion) { return criterion.met(subject); });
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

}  // namespace sphverify
