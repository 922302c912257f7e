// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include <cstring>

#include "formulations/simd/pack.hpp"

namespace sphverify::SPHVERIFY_INSTRUCTION_SET {

/// Eight numbers of single precision.
struct Eight {
  typedef float Lanes __attribute__((vector_size(32)));
  typedef std::int32_t Mask __attribute__((vector_size(32)));
  static constexpr std::size_t size = 8;

  Lanes lanes;

  Eight() = default;
  SPHVERIFY_INLINE Eight(float all) : lanes{all, all, all, all, all, all, all, all} {}
  SPHVERIFY_INLINE Eight(Lanes l) : lanes(l) {}

  SPHVERIFY_INLINE static Eight load(float const* from) {
    Eight loaded;
    std::memcpy(&loaded.lanes, from, sizeof loaded.lanes);
    return loaded;
  }
  /// (from[n] + shift - origin) * scale, in double precision up to here.
  SPHVERIFY_INLINE static Eight load(double const* from, double shift, double origin, double scale) {
    typedef float Half __attribute__((vector_size(16)));
    Half half[2];
    for (std::size_t n = 0; n < 2; ++n) {
      Pack four;
      std::memcpy(&four.lanes, from + n * Pack::size, sizeof four.lanes);
      half[n] = __builtin_convertvector((((four + shift) - origin) * scale).lanes, Half);
    }
    return __builtin_shufflevector(half[0], half[1], 0, 1, 2, 3, 4, 5, 6, 7);
  }

  SPHVERIFY_INLINE friend Eight operator+(Eight a, Eight b) { return a.lanes + b.lanes; }
  SPHVERIFY_INLINE friend Eight operator-(Eight a, Eight b) { return a.lanes - b.lanes; }
  SPHVERIFY_INLINE friend Eight operator*(Eight a, Eight b) { return a.lanes * b.lanes; }
  SPHVERIFY_INLINE friend Mask operator<(Eight a, Eight b) { return a.lanes < b.lanes; }
  SPHVERIFY_INLINE friend Mask operator>(Eight a, Eight b) { return a.lanes > b.lanes; }
  SPHVERIFY_INLINE friend Mask operator==(Eight a, Eight b) { return a.lanes == b.lanes; }
  SPHVERIFY_INLINE friend Eight magnitude(Eight a) {
    return reinterpret_cast<Lanes>(reinterpret_cast<Mask>(a.lanes) & 0x7fffffff);
  }
  /// 0 for what is no number.
  SPHVERIFY_INLINE friend Eight positive_part(Eight a) { return (a.lanes > 0.0f) ? a.lanes : Lanes{}; }
};

/// A bit for every lane, the first's the lowest.
SPHVERIFY_INLINE unsigned bits_of(Eight::Mask mask) {
#if defined(__AVX2__)
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
#else
  Eight::Mask bit = mask & Eight::Mask{1, 2, 4, 8, 16, 32, 64, 128};
  bit |= __builtin_shufflevector(bit, bit, 4, 5, 6, 7, 0, 1, 2, 3);
  bit |= __builtin_shufflevector(bit, bit, 2, 3, 0, 1, 6, 7, 4, 5);
  return static_cast<unsigned>(bit[0] | bit[1]);
#endif
}

#if defined(__AVX2__)
/// For every set of lanes, which of them goes where when they are moved to the front.
struct Fronts {
  alignas(8) std::uint8_t lane[256][8];
  constexpr Fronts() : lane{} {
    for (unsigned set = 0; set < 256; ++set) {
      unsigned to = 0;
      for (unsigned from = 0; from < 8; ++from) {
        if ((set >> from & 1u) != 0) lane[set][to++] = static_cast<std::uint8_t>(from);
      }
    }
  }
};
inline constexpr Fronts fronts{};
#endif

/// Moves the lanes of a set to the front.
class ToFront {
 public:
#if defined(__AVX2__)
  SPHVERIFY_INLINE explicit ToFront(unsigned set)
      : lane_(_mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<__m128i const*>(fronts.lane[set])))) {}
  /// Writes all eight, those of the set first.
  SPHVERIFY_INLINE void store(Eight from, float* to) const {
    store_lanes(reinterpret_cast<__m256i>(from.lanes), to);
  }
  SPHVERIFY_INLINE void store(std::uint32_t const* from, std::uint32_t* to) const {
    store_lanes(_mm256_loadu_si256(reinterpret_cast<__m256i const*>(from)), to);
  }

 private:
  SPHVERIFY_INLINE void store_lanes(__m256i lanes, void* to) const {
    _mm256_storeu_si256(static_cast<__m256i*>(to), _mm256_permutevar8x32_epi32(lanes, lane_));
  }

  __m256i lane_;
#else
  SPHVERIFY_INLINE explicit ToFront(unsigned set) : set_(set) {}
  SPHVERIFY_INLINE void store(Eight from, float* to) const { store_lanes(from.lanes, to); }
  SPHVERIFY_INLINE void store(std::uint32_t const* from, std::uint32_t* to) const { store_lanes(from, to); }

 private:
  // Written whether in the set or not, and kept by counting on: a branch would often be mispredicted.
  template <class From, class To>
  SPHVERIFY_INLINE void store_lanes(From const& from, To* to) const {
    for (std::size_t l = 0; l < Eight::size; ++l) {
      *to = from[l];
      to += set_ >> l & 1u;
    }
  }

  unsigned set_;
#endif
};

}  // namespace sphverify::SPHVERIFY_INSTRUCTION_SET
