// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/packs/ours.hpp"

void sphverify::bench::ours_of_eight(PackSample const& sample, double* out) { sweep_rows<Ours<Eight>>(sample, out); }
