// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify {

/// The one or the other, both of which are computed: what formulas write for `?:` that serve one number and several
/// at once alike.
constexpr double select(bool condition, double yes, double no) { return condition ? yes : no; }

}  // namespace sphverify
