// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cases/support/problem.hpp"
#include "formulations/particles/particles.hpp"
#include "harness/measure/norms.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// Features of the exact solution at the final time; none of rates, which have no time.
template <int Dim>
Features<Dim> final_features(Problem<Dim> const& problem) {
  return problem.features ? problem.features(problem.final_time) : Features<Dim>{};
}

/// Adds to the errors of fields at the final time what they are to be read by: of scalars the weighted mean
/// with its sign; the norms that the initial state would score, which is the exact field of time 0 at the
/// places where the particles are now; the orders that features of the solution allow. What is not a number
/// is left out.
/// @param weights and regions that the errors were taken with
template <int Dim>
void add_error_context(Problem<Dim> const& problem, Particles<Dim> const& particles,
                       std::vector<double> const& weights, std::vector<Region> const& regions,
                       std::map<std::string, FieldErrors>& errors);

}  // namespace sphverify
