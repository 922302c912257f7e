#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

// The search for neighbours as plain data, for the same reason as the sweep over them (sweep.hpp).
namespace sphverify {

/// Candidates for the neighbours of a cell's particles, side by side: places (Dim arrays), and their parts of
/// the reach where these differ. Filled up to whole packs with ones that are far away, aligned to 32 bytes.
struct Candidates {
  std::array<double const*, 3> x;
  double const* half_reach;  ///< null where all pairs have the same reach
  std::uint32_t const* particle;
  std::size_t count;  ///< a multiple of 4
};

/// The loops that find neighbours in one dimension, compiled for one instruction set.
struct ListKernels {
  /// Writes the candidates that lie closer than reach to x to `out`, which has room for 4 more than there
  /// are; returns their number, and whether one of them is at x.
  std::size_t (*list_near)(Candidates const& all, double const* x, double reach, std::uint32_t* out,
                           bool* same_place);
};

}  // namespace sphverify
