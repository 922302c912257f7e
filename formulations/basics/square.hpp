// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify {

constexpr auto square(auto x) { return x * x; }

}  // namespace sphverify
