// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "cases/support/case.hpp"
#include "cases/support/problem.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// About how many bytes a run holds at its peak: fields, neighbour list, what the integrator keeps. An
/// estimate from what is allocated; meant to refuse what cannot be. A test holds it to within 30% of the
/// peaks of runs in 2D and 3D at h/dx = 1.2 (tests/cli/test_memory.py); two-pass forms on particles at rest
/// take less.
/// @param integrator of a moving gas; leapfrog keeps fewest copies
/// @param support of the kernel at this resolution [dx]
/// Throws std::invalid_argument for a layout that the problem's dimension does not have.
double estimated_bytes(CaseKind kind, std::string_view integrator, AnyProblem const& problem,
                       LayoutChoice const& layout, int resolution, double support);

/// Why the problem's dimension does not have a layout; empty if it does.
std::string why_not(AnyProblem const& problem, LayoutChoice const& layout);

/// Particles that a run would have, as a number that does not overflow.
double estimated_particles(AnyProblem const& problem, LayoutChoice const& layout, int resolution);

/// Pairs of neighbours that a run would have, each counted from both sides.
/// @param support of the kernel at this resolution [dx]
double estimated_pairs(AnyProblem const& problem, LayoutChoice const& layout, int resolution, double support);

/// What a form of heat conduction that brings pair weights of its own keeps besides: a second list, with a weight beside each
/// index [bytes]; 0 for all others.
double bytes_of_weights(FormulationChoice const& formulation, AnyProblem const& problem, LayoutChoice const& layout,
                        int resolution, double support);

}  // namespace sphverify
