// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/packs/highway.hpp"

void sphverify::bench::highway_of_eight(PackSample const& sample, double* out) { sweep_rows<Highway<Eight>>(sample, out); }
