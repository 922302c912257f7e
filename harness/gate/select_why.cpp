// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "cases/support/case.hpp"
#include "formulations/rate_operator.hpp"
#include "harness/gate/criteria.hpp"
#include "harness/gate/measure.hpp"
#include "harness/gate/select.hpp"
#include "harness/gate/text.hpp"
#include "reports/user_error.hpp"

// Why a selection, or an entry of one of its lists, matches nothing.
namespace sphverify {

namespace {

using Runs = std::vector<RunRecord const*>;

Runs runs_that_meet(Criterion<RunRecord> const& criterion, Runs runs) {
  std::erase_if(runs, [&](RunRecord const* run) { return !criterion.met(*run); });
  return runs;
}

/// What runs have where a key stands, each value once.
std::string values_of(Criterion<RunRecord> const& criterion, Runs const& runs) {
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

/// Suggests for the first of several names that does not exist, but nearly does.
class Suggestion {
 public:
  template <class NameOf>
  void look_for(std::string const& wanted, Runs const& runs, NameOf const& name_of) {
    if (!text_.empty()) return;
    std::set<std::string> existing;
    for (RunRecord const* run : runs) name_of(*run, existing);
    if (existing.contains(wanted)) return;
    std::string const near = nearest(wanted, {existing.begin(), existing.end()});
    if (!near.empty()) text_ = fmt::format(" (did you mean '{}'?)", near);
  }
  std::string const& text() const { return text_; }

 private:
  std::string text_;
};

using Names = std::set<std::string>;

/// Names of parameters, and words that one may have.
void look_for_parameters(std::map<std::string, ParameterValue> const& named, Runs const& runs,
                         Suggestion& suggestion) {
  for (auto const& [parameter, value] : named) {
    suggestion.look_for(parameter, runs, [](RunRecord const& run, Names& names) {
      for (auto const& [known, any] : run.parameters) names.insert(known);
    });
    auto const* const word = std::get_if<std::string>(&value);
    if (word == nullptr) continue;
    suggestion.look_for(*word, runs, [&name = parameter](RunRecord const& run, Names& names) {
      auto const found = run.parameters.find(name);
      if (found == run.parameters.end()) return;
      if (auto const* const known = std::get_if<std::string>(&found->second)) names.insert(*known);
    });
  }
}

void look_for_formulation(FormulationMatch const& match, Runs const& runs, Suggestion& suggestion) {
  auto const look_for = [&](std::string const& id, std::string FormulationChoice::*member) {
    // A form that this program has is not misspelt, but was not run.
    if (id.empty() || find_scheme(id) != nullptr) return;
    suggestion.look_for(id, runs,
                        [&](RunRecord const& run, Names& names) { names.insert(run.formulation.*member); });
  };
  look_for(match.id, &FormulationChoice::id);
  look_for(match.work.value_or(""), &FormulationChoice::work);
  look_for(match.conduction.value_or(""), &FormulationChoice::conduction);
}

/// What may have been meant by names under a key of the selection that no run has.
std::string suggestion_for(std::string const& key, Select const& select, Runs const& runs) {
  Suggestion suggestion;
  if (key == "case") {
    for (CaseMatch const& match : select.cases) {
      if (find_case(match.id) != nullptr) continue;
      suggestion.look_for(match.id, runs,
                          [](RunRecord const& run, Names& names) { names.insert(run.case_id); });
    }
  } else if (key == "parameters") {
    look_for_parameters(select.parameters, runs, suggestion);
    for (CaseMatch const& match : select.cases) look_for_parameters(match.parameters, runs, suggestion);
  } else if (key == "formulation") {
    for (FormulationMatch const& match : select.formulations) look_for_formulation(match, runs, suggestion);
  } else if (key == "discretisation.layout") {
    for (LayoutMatch const& match : select.layouts) {
      suggestion.look_for(match.id, runs, [](RunRecord const& run, Names& names) {
        names.insert(run.discretisation.layout.id);
      });
    }
  }
  for (WordKey const& word : word_keys) {
    auto const named = select.words.find(word.key);
    if (named == select.words.end() || key != std::string("discretisation.") + word.key) continue;
    for (std::string const& wanted : named->second) {
      suggestion.look_for(wanted, runs, [&](RunRecord const& run, Names& names) {
        names.insert(run.discretisation.*word.member);
      });
    }
  }
  return suggestion.text();
}

/// One entry of a list in a selection, and the selection with that entry alone.
struct Alternative {
  std::string key, entry;
  Select alone;
};

template <class Entry, class Text>
void add_alternatives(std::vector<Alternative>& all, std::string const& key, Select const& select,
                      std::vector<Entry> const& entries, std::vector<Entry> Select::*member,
                      Text const& text) {
  if (entries.size() < 2) return;
  for (auto const& entry : entries) {
    Alternative& one = all.emplace_back(Alternative{key, text(entry), select});
    one.alone.*member = {entry};
  }
}

std::string text_of(CaseMatch const& match) {
  return match.parameters.empty() ? match.id : match.id + " " + parameters_json(match.parameters).dump();
}

std::string text_of(FormulationMatch const& match) {
  std::string text = match.id;
  for (auto const& partner : {match.work, match.conduction}) {
    if (partner && !partner->empty()) text += " + " + *partner;
  }
  if (match.walls) text += " (walls " + match.walls->word + ")";
  return text;
}

std::string text_of(LayoutMatch const& match) {
  std::string text = match.id;
  if (match.amplitude) text += fmt::format(" {:g}", *match.amplitude);
  if (match.seed) text += fmt::format(" seed {}", *match.seed);
  if (match.voronoi_masses) text += *match.voronoi_masses ? ", Voronoi masses" : ", the layout's own masses";
  return text;
}

std::vector<Alternative> alternatives(Select const& select) {
  std::vector<Alternative> all;
  auto const text = [](auto const& entry) { return text_of(entry); };
  auto const number = [](auto const& entry) { return fmt::format("{}", entry); };
  add_alternatives(all, "case", select, select.cases, &Select::cases, text);
  add_alternatives(all, "formulation", select, select.formulations, &Select::formulations, text);
  add_alternatives(all, "walls", select, select.walls, &Select::walls,
                   [](bool on) { return std::string(on ? "on" : "off"); });
  for (auto const& [key, words] : select.words) {
    if (words.size() < 2) continue;
    for (std::string const& word : words) {
      Alternative& one = all.emplace_back(Alternative{"discretisation." + key, word, select});
      one.alone.words[key] = {word};
    }
  }
  add_alternatives(all, "discretisation.smoothing_ratio", select, select.smoothing_ratios,
                   &Select::smoothing_ratios, number);
  add_alternatives(all, "discretisation.layout", select, select.layouts, &Select::layouts, text);
  add_alternatives(all, "discretisation.viscosity", select, select.viscosities, &Select::viscosities,
                   [](ViscosityChoice const& viscosity) { return to_json(viscosity).dump(); });
  add_alternatives(all, "resolution", select, select.resolutions, &Select::resolutions, number);
  add_alternatives(all, "smoothing_exponent", select, select.smoothing_exponents,
                   &Select::smoothing_exponents, number);
  return all;
}

}  // namespace

std::string why_empty(Gate const& gate, Results const& results) {
  if (results.runs.empty()) return "the results hold no run";
  std::vector<Criterion<RunRecord>> const all = run_criteria(gate.select);
  Runs runs;
  for (RunRecord const& run : results.runs) runs.push_back(&run);
  for (auto const& criterion : all) {
    if (runs_that_meet(criterion, runs).empty()) {
      return fmt::format("no run matches '{}'; the runs have {}{}", criterion.key, values_of(criterion, runs),
                         suggestion_for(criterion.key, gate.select, runs));
    }
  }
  std::vector<std::string> narrowing;  // keys that leave some of the runs out
  for (auto const& criterion : all) {
    Runs const left = runs_that_meet(criterion, runs);
    if (left.empty()) {
      return fmt::format("no run that matches '{}' also matches '{}'; those runs have {}{}",
                         fmt::join(narrowing, "' and '"), criterion.key, values_of(criterion, runs),
                         suggestion_for(criterion.key, gate.select, runs));
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

std::string unmatched_entry(Gate const& gate, Results const& results) {
  for (Alternative const& one : alternatives(gate.select)) {
    Gate alone = gate;
    alone.select = one.alone;
    alone.relative_to = {};  // what is compared to may stand in a list beside the others
    if (count_selected(alone, results) > 0) continue;
    return fmt::format("'{}' in the list of '{}' matches nothing: {}", without_control(one.entry), one.key,
                       why_empty(alone, results));
  }
  return "";
}

}  // namespace sphverify
