// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify {

/// Which particles make a pair where each has a smoothing length of its own: those closer than the mean of their supports, as
/// forms need that take the pair's mean h, or closer than the larger of the two, as forms need that take both.
enum class PairSupport { mean, larger };

}  // namespace sphverify
