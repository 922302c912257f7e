// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "harness/codes/snapshot.hpp"
#include "harness/codes/snapshot_options.hpp"

// The HDF5 library is an optional part of the build: without it these say so in a UserError.
namespace sphverify {

bool can_read_hdf5();

/// Reads an HDF5 snapshot: ours (`hdf5`), SWIFT's, Gadget's or GIZMO's (`gadget`), or PySPH's (`pysph`); `auto` looks which it
/// is. Particles of other types than gas, dead ones and ghosts are left out.
/// Throws UserError with file and data set.
Snapshot read_hdf5_snapshot(std::string const& path, SnapshotOptions const& options);

/// What a format needs beside the particles.
struct Hdf5Choice {
  std::string format;             ///< hdf5, swift or pysph
  int dimension;
  std::vector<double> box;        ///< edges of the domain [m]; of swift
  double support_over_h;          ///< of the kernel; of swift
  double support_over_two_sigma;  ///< likewise
};

/// Writes an HDF5 file of particles.
void write_hdf5_snapshot(std::string const& path, Snapshot const& snapshot, Hdf5Choice const& choice);

}  // namespace sphverify
