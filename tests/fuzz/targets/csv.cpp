// SPDX-License-Identifier: GPL-3.0-or-later
// A snapshot in text.
#include "tests/fuzz/target.hpp"
#include "tests/fuzz/targets/assess_file.hpp"

namespace sphverify::fuzz {

void take_csv(std::string const& file) { assess_file(file, "auto"); }

}  // namespace sphverify::fuzz
