// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace sphverify::fuzz {

/// Assesses a snapshot as if it were of each of a few cases, of one, two and three dimensions, with and
/// without choices that its numbers go through.
/// @param format as a document says it
void assess_file(std::string const& file, std::string const& format);

}  // namespace sphverify::fuzz
