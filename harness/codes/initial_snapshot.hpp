// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/support/case.hpp"
#include "harness/codes/snapshot.hpp"
#include "reports/json/node.hpp"

namespace sphverify {

/// The particles that our own runs of a case begin with, as a snapshot at time 0: positions, velocities, masses, smoothing
/// lengths and the fields that the case knows. Where a jump cuts a particle's cell, it has what the cell holds.
/// @param smoothing_ratio h/dx at this resolution
/// Throws std::invalid_argument for a layout that the case cannot have.
Snapshot initial_snapshot(CaseKind kind, AnyProblem const& problem, Discretisation const& discretisation, int resolution,
                          double smoothing_ratio);

/// What a code must know beside the particles (sphverify-particles/1): the domain, the walls and what they prescribe, the
/// final time, gamma, which sources drive the case. What varies with time is tabulated.
Json case_sheet(Case const& one, Parameters const& parameters, AnyProblem const& problem, Discretisation const& discretisation,
                int resolution, double smoothing_ratio);

/// Writes the particles in a format of `initial_formats`. Throws UserError where the file cannot be written, or the build has
/// no HDF5.
void write_initial_particles(std::string const& path, std::string const& format, Snapshot const& snapshot,
                             AnyProblem const& problem, Discretisation const& discretisation);

}  // namespace sphverify
