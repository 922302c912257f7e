// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "formulations/neighbours/pair_support.hpp"

// The search for neighbours as plain data, for the same reason as the sweep over them (sweep.hpp).
namespace sphverify {

/// How many candidates are looked at together. Arrays of them can be read, and written, so many beyond the
/// last.
inline constexpr std::size_t candidates_at_a_time = 8;

/// All particles in the order of the grid's cells.
struct SortedPlaces {
  double const* x[3];           ///< along the box's axes [m]
  double const* half_reach;     ///< [m]; null where all pairs have the same reach
  std::uint32_t const* number;  ///< which particle
  PairSupport support = PairSupport::mean;  ///< whether a pair's reach is the sum of its halves or twice the larger
};

/// The box around a cell's own particles, in which candidates for their neighbours are measured: places from
/// its centre, lengths over the grid's reach.
struct HomeBox {
  double centre[3];          ///< along the box's axes [m]
  double per_reach;          ///< 1 / the grid's reach  [1/m]
  float half_extent[3];      ///< over the reach
  float largest_half_reach;  ///< over the reach; 1/2 where all pairs have the same
  float margin;              ///< what squared distances that are near the squared reach may be wrong by
};

/// Candidates from a stretch of the sorted particles and how they are moved to the image near the home box.
struct CandidateRun {
  std::size_t first;  ///< candidate
  double shift[3];    ///< [m]
};

/// Candidates for the neighbours of a cell's particles, side by side.
struct Candidates {
  float* x[3];            ///< from the home box's centre, over the reach
  float* half_reach;      ///< over the reach
  std::uint32_t* place;   ///< among the sorted particles
  std::uint32_t* number;  ///< which particle
  std::size_t count;
  CandidateRun const* runs;
  std::size_t run_count;
};

/// The loops that find neighbours in one dimension, compiled for one instruction set. A set of candidates is
/// a bit for each, in whole bytes.
struct ListKernels {
  /// Adds those of the sorted particles begin to end that, once shifted, may be near to some place of the
  /// home box.
  void (*add)(SortedPlaces const& all, HomeBox const& home, std::size_t begin, std::size_t end,
              double const* shift, Candidates& to);
  /// Writes the set of candidates that are nearer than a reach to one of their number, itself left out.
  /// @param reach where all pairs have the same reach [m]
  /// @param near filled up to a multiple of 8 bytes
  /// @return how many they are; whether one of them is at the very place is added to `same_place`
  std::size_t (*find_near)(SortedPlaces const& all, HomeBox const& home, Candidates const& candidates,
                           std::size_t self, double reach, std::uint8_t* near, bool& same_place);
  /// Writes the numbers of a set's members, as many as there are from `out` to `end`.
  void (*list)(std::uint32_t const* number, std::uint8_t const* set, std::uint32_t* out, std::uint32_t* end);
};

}  // namespace sphverify
