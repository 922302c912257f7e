// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "harness/study/line_channel.hpp"
#include "harness/study/shared_study.hpp"

namespace sphverify {

/// Carries out the units that come over the channel, each in a process of its own, so that one which dies takes nothing
/// with it, until the channel says or comes to an end. The calling process must have one thread.
///
/// Comes in: {"unit": [runs], "threads": n, "known": [[place, record], ...]}, {"end": true}.
/// Goes out: {"started": place}, {"run": place, "record": ...}, then {"done": true}, or {"crashed": why}; {"leaving": true}
/// where this process was asked to stop.
void work(LineChannel& channel, SharedStudy const& shared);

}  // namespace sphverify
