// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/expected_work.hpp"

#include <optional>

#include "formulations/kernels/kernel.hpp"

namespace sphverify {

double support_of(RunSpec const& run) {
  return kernel(run.discretisation.kernel, 1).support_ratio() * run.smoothing_ratio;
}

std::vector<RunProgress> expected_work(std::vector<RunSpec> const& runs) {
  std::vector<RunProgress> all;
  std::optional<AnyProblem> problem;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    RunSpec const& run = runs[k];
    RunProgress one;
    if (k > 0) {
      // Runs stand in the order of their cases.
      RunSpec const& before = runs[k - 1];
      bool const is_same =
          run.scene_case == before.scene_case && run.parameters.all() == before.parameters.all();
      one.kind = all.back().kind + (is_same ? 0 : 1);
      if (!is_same) problem.reset();
    }
    if (!problem) problem = run.scene_case->problem(run.parameters);
    one.work = estimated_work(*problem, run.discretisation.layout, run.resolution, support_of(run));
    all.push_back(one);
  }
  return all;
}

}  // namespace sphverify
