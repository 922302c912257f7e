// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace sphverify {

/// Times at which a run is looked at, whatever its integrator's steps: 0; 192 from a millionth of the final
/// time to it, evenly in their logarithm, so that the first moments are seen; and the ends of 192 equal
/// parts. Ascending, all different.
std::vector<double> sample_times(double final_time);

}  // namespace sphverify
