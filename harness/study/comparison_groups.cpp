// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/comparison_groups.hpp"

#include <map>
#include <numeric>

namespace sphverify {

namespace {

bool only_formulations_differ(RunSpec const& a, RunSpec const& b) {
  return a.scene_case == b.scene_case && a.parameters.all() == b.parameters.all() &&
         a.discretisation == b.discretisation && a.smoothing_exponent == b.smoothing_exponent &&
         a.resolution == b.resolution;
}

}  // namespace

std::vector<std::size_t> comparison_groups(std::vector<RunSpec> const& runs) {
  std::vector<std::size_t> group_of(runs.size());
  std::map<int, std::vector<std::size_t>> firsts;  // of each resolution, the first run of every group
  std::size_t groups = 0;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    std::vector<std::size_t>& known = firsts[runs[k].resolution];
    std::size_t n = 0;
    while (n < known.size() && !only_formulations_differ(runs[known[n]], runs[k])) ++n;
    if (n == known.size()) {
      known.push_back(k);
      group_of[k] = groups++;
    } else {
      group_of[k] = group_of[known[n]];
    }
  }
  return group_of;
}

std::vector<std::size_t> timing_groups(std::vector<RunSpec> const& runs, MeasureSet const& measure, RepeatRule const& repeat) {
  if (measure.contains(Measure::cost) && repeat.most > 1) return comparison_groups(runs);
  std::vector<std::size_t> groups(runs.size());
  std::iota(groups.begin(), groups.end(), std::size_t{0});
  return groups;
}

}  // namespace sphverify
