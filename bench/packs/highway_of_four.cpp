#include "bench/packs/highway.hpp"

void sphverify::bench::highway_of_four(PackSample const& sample, double* out) { sweep_rows<Highway<Four>>(sample, out); }
