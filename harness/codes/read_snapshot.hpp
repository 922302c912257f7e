// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "cases/support/problem.hpp"
#include "formulations/kernels/kernel.hpp"
#include "harness/codes/snapshot.hpp"
#include "harness/codes/snapshot_options.hpp"

namespace sphverify {

/// Reads the snapshot in one file, or in several that hold parts of it. What was taken for what stands in its remarks.
/// Throws UserError.
Snapshot read_snapshot(std::vector<std::string> const& files, SnapshotOptions const& options);

/// Makes a snapshot fit a domain of that dimension: takes the axes that are meant, moves its origin, wraps positions into
/// periods, and leaves out columns that the dimension does not have. What is done is said in its remarks.
/// Throws UserError where positions or a mass are missing.
/// @param kernel for which its smoothing lengths are wanted
/// @param gamma of the case; 0 where nothing flows
template <int Dim>
void fit_to_domain(Snapshot& snapshot, SnapshotOptions const& options, Domain<Dim> const& domain, Kernel const& kernel,
                   double gamma);

/// Adds columns that are missing and follow from the rest: density from h, if that is asked for, and of a gas energy from
/// pressure or temperature and pressure from energy.
/// @param gamma of the case; 0 where nothing flows
template <int Dim>
void derive_missing(Snapshot& snapshot, SnapshotOptions const& options, double gamma);

/// Makes smoothing lengths those of a kernel of the same support.
void convert_lengths(Snapshot& snapshot, LengthConvention convention, Kernel const& kernel);

/// A kernel's support over twice its standard deviation along an axis: what SWIFT calls "Kernel gamma" (Dehnen & Aly 2012,
/// Eq. 8 and Table 1).
double support_over_two_sigma(Kernel const& kernel);

}  // namespace sphverify
