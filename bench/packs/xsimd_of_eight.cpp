// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/packs/xsimd.hpp"

void sphverify::bench::xsimd_of_eight(PackSample const& sample, double* out) {
  sweep_rows<Xsimd<Eight, xsimd::avx512f>>(sample, out);
}
