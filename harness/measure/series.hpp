// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "reports/results.hpp"

namespace sphverify {

/// Groups runs that differ only in resolution and in the seed of a jittered layout, and measures every
/// ladder: observed orders with verdicts by field, region and norm, and the run time that reaches 10%, 1% and
/// 0.1% of the exact field's norm, interpolated in logarithms on the curve of error over run time, with the
/// ends of its interval from those of the runs on either side. A level of which any replicate failed has no
/// error: the mean over the survivors would flatter it. The same at any number of threads.
std::vector<Series> build_series(std::vector<RunRecord> const& runs, int threads = 1);

}  // namespace sphverify
