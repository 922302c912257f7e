// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/codes/hdf5.hpp"
#include "reports/user_error.hpp"

// For a build without the HDF5 library.
namespace sphverify {

bool can_read_hdf5() { return false; }

Snapshot read_hdf5_snapshot(std::string const& path, SnapshotOptions const&) {
  throw UserError(path, "", "an HDF5 file, and a program that was built without libhdf5-dev", "CSV, or a build with it");
}

void write_hdf5_snapshot(std::string const& path, Snapshot const&, Hdf5Choice const& choice) {
  throw UserError(path, "--format", choice.format + ", and a program that was built without libhdf5-dev",
                  "csv, or a build with it");
}

}  // namespace sphverify
