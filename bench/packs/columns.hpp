// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

// Four columns of four or eight rows, by shuffles of the compiler's vectors.
namespace sphverify::bench {

typedef double Four __attribute__((vector_size(32)));
typedef double Eight __attribute__((vector_size(64)));

__attribute__((always_inline)) inline void transpose(double const* const* rows, Four* column) {
  auto const load = [](double const* from) { return *reinterpret_cast<Four const*>(from); };
  Four const a = load(rows[0]), b = load(rows[1]), c = load(rows[2]), d = load(rows[3]);
  Four const ac = __builtin_shufflevector(a, c, 0, 1, 4, 5), bd = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  Four const AC = __builtin_shufflevector(a, c, 2, 3, 6, 7), BD = __builtin_shufflevector(b, d, 2, 3, 6, 7);
  column[0] = __builtin_shufflevector(ac, bd, 0, 4, 2, 6);
  column[1] = __builtin_shufflevector(ac, bd, 1, 5, 3, 7);
  column[2] = __builtin_shufflevector(AC, BD, 0, 4, 2, 6);
  column[3] = __builtin_shufflevector(AC, BD, 1, 5, 3, 7);
}

/// Lanes stay in the order of the rows.
__attribute__((always_inline)) inline void transpose(double const* const* rows, Eight* column) {
  auto const pair = [&](std::size_t l) {
    return __builtin_shufflevector(*reinterpret_cast<Four const*>(rows[l]), *reinterpret_cast<Four const*>(rows[l + 1]), 0, 1,
                                   2, 3, 4, 5, 6, 7);
  };
  Eight const a = pair(0), b = pair(2), c = pair(4), d = pair(6);
  Eight const ab0 = __builtin_shufflevector(a, b, 0, 4, 8, 12, 1, 5, 9, 13), cd0 = __builtin_shufflevector(c, d, 0, 4, 8, 12, 1, 5, 9, 13);
  Eight const ab2 = __builtin_shufflevector(a, b, 2, 6, 10, 14, 3, 7, 11, 15), cd2 = __builtin_shufflevector(c, d, 2, 6, 10, 14, 3, 7, 11, 15);
  column[0] = __builtin_shufflevector(ab0, cd0, 0, 1, 2, 3, 8, 9, 10, 11);
  column[1] = __builtin_shufflevector(ab0, cd0, 4, 5, 6, 7, 12, 13, 14, 15);
  column[2] = __builtin_shufflevector(ab2, cd2, 0, 1, 2, 3, 8, 9, 10, 11);
  column[3] = __builtin_shufflevector(ab2, cd2, 4, 5, 6, 7, 12, 13, 14, 15);
}

}  // namespace sphverify::bench
