// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace sphverify {

/// What may become of a run (contract).
inline std::vector<std::string> const run_statuses{"ok",        "unstable", "non-finite", "positivity-lost",
                                                   "timed-out", "invalid",  "failed",   "crashed"};

}  // namespace sphverify
