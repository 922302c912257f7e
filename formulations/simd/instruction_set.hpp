// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify {

#if defined(__x86_64__)
inline constexpr bool architecture_may_have_avx2 = true;
#else
inline constexpr bool architecture_may_have_avx2 = false;
#endif

/// Whether this processor is an x86-64 with AVX2 and fused multiply-add, for which the hot loops exist once more; every
/// machine of the architecture has the others. Results of the two differ by round-off.
inline bool processor_has_avx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

}  // namespace sphverify
