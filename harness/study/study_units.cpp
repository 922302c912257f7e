// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/study_units.hpp"

#include "harness/study/comparison_groups.hpp"
#include "harness/study/expected_work.hpp"

namespace sphverify {

namespace {

bool same_ladder(RunSpec const& a, RunSpec const& b) {
  return a.scene_case == b.scene_case && a.parameters.all() == b.parameters.all() && a.formulation == b.formulation &&
         a.discretisation == b.discretisation && a.smoothing_exponent == b.smoothing_exponent;
}

}  // namespace

std::vector<StudyUnit> study_units(Study const& study, std::vector<RunSpec> const& runs) {
  std::vector<std::size_t> const group_of = timing_groups(runs, study.measure, study.repeat);
  std::vector<RunProgress> const expected = expected_work(runs);
  std::vector<StudyUnit> units;
  std::vector<std::size_t> unit_of_group(runs.size(), runs.size());
  std::size_t ladder = 0;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    // Levels of a ladder stand one after the other.
    if (k > 0 && !same_ladder(runs[k - 1], runs[k])) ++ladder;
    std::size_t& unit = unit_of_group[group_of[k]];
    if (unit == runs.size()) {
      unit = units.size();
      units.push_back({{}, ladder, 0.0});
    }
    units[unit].runs.push_back(k);
    units[unit].work += expected[k].work;
  }
  return units;
}

std::size_t journal_place(Study const& study, std::size_t run) {
  return study.envelope ? run * static_cast<std::size_t>(most_runs(*study.envelope)) : run;
}

}  // namespace sphverify
