// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/packs/xsimd.hpp"

void sphverify::bench::xsimd_of_four(PackSample const& sample, double* out) {
  sweep_rows<Xsimd<Four, xsimd::fma3<xsimd::avx2>>>(sample, out);
}
