// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace sphverify {

/// Of what computes: this program's file and those of its plug-ins, by their CRC-32 and length, joined by spaces. Two builds have
/// the same only if these files are the same; of libraries that they load nothing is known. Empty for a file that cannot be read.
std::string fingerprint(std::vector<std::string> const& plugins);

}  // namespace sphverify
