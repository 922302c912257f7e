// SPDX-License-Identifier: 0BSD
// What sphverify_add_program wrote for examples/own-parts in version 0.1.
#include <tuple>

#include "formulations/all.hpp"
#include "harness/cli/program.hpp"
#include "gdf.hpp"
#include "linear_gradient.hpp"
#include "geometric.hpp"
#include "lucy.hpp"
#include "nearest_walls.hpp"
#include "decaying_wave.hpp"

int main(int argc, char** argv) {
  return sphverify::program_main(argc, argv, {.name = "my-verify", .add_parts = [] {
    sphverify::add_scheme<::GeometricDensityAverage>();
    sphverify::add_scheme<::GeometricDensityAverageWork>();
    sphverify::add_scheme<::LinearGradient>();
    sphverify::add_scheme<::GeometricConduction>();
    sphverify::add_kernel<::Lucy>();
    sphverify::add_wall_treatment<::NearestWalls>();
    sphverify::add_case<::DecayingWave>();
  }});
}
