// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>

namespace sphverify {

/// States a precondition of ours; a violation is a mistake in this project, never the user's. Checked in
/// builds with assertions, free in release.
inline void expects([[maybe_unused]] bool condition) { assert(condition); }

}  // namespace sphverify
