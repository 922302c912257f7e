// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/packs/ours.hpp"

void sphverify::bench::ours_of_four(PackSample const& sample, double* out) { sweep_rows<Ours<Four>>(sample, out); }
