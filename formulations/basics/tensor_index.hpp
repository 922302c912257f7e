// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify {

/// Where the element (k, l) of a symmetric tensor lies among its Dim(Dim + 1)/2 different ones: xx, xy, yy, xz, yz, zz.
constexpr int tensor_index(int k, int l) { return k <= l ? l * (l + 1) / 2 + k : k * (k + 1) / 2 + l; }

}  // namespace sphverify
