// SPDX-License-Identifier: GPL-3.0-or-later
// A snapshot in HDF5, byte by byte: mostly a test of how that library's refusals are told.
#include "tests/fuzz/target.hpp"
#include "tests/fuzz/targets/assess_file.hpp"

namespace sphverify::fuzz {

void take_hdf5(std::string const& file) { assess_file(file, "auto"); }

}  // namespace sphverify::fuzz
