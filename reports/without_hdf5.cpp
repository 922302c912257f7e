// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "reports/hdf5.hpp"

// For a build without the HDF5 library.
namespace sphverify {

bool can_use_hdf5() { return false; }

std::string hdf5_file(Column const&) { throw std::logic_error("HDF5 without its library"); }

Column read_hdf5_file(std::string, std::string const& path) {
  throw UserError(path, "", "an HDF5 file, and a program that was built without libhdf5-dev", "JSON, or a build with it");
}

}  // namespace sphverify
