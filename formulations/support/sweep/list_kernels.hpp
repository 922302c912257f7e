#pragma once

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include "formulations/support/sweep/candidates.hpp"
#include "formulations/support/sweep/pack.hpp"

// The loops that find neighbours. Included by the files that are compiled once per instruction set, and by
// nothing else.
namespace sphverify::SPHVERIFY_INSTRUCTION_SET {

/// Which candidates are near. Holds copies of what it reads: writing a list must not make it read them anew.
template <int Dim, bool own_reaches>
struct Nearness {
  double const* x[Dim];
  double const* half_reach;
  Pack from[Dim];
  Pack reach, squared_reach;

  SPHVERIFY_INLINE Nearness(Candidates const& all, double const* place, double r)
      : half_reach(all.half_reach), reach(r), squared_reach(r * r) {
    for (std::size_t n = 0; n < Dim; ++n) {
      x[n] = all.x[n];
      from[n] = place[n];
    }
  }

  /// Squared distances of candidates k to k + 3.
  SPHVERIFY_INLINE Pack squared_distance(std::size_t k) const {
    Pack squared = 0.0;
    for (std::size_t n = 0; n < Dim; ++n) {
      Pack const along = from[n] - Pack::load(x[n] + k);
      squared += along * along;
    }
    return squared;
  }
  SPHVERIFY_INLINE Pack::Mask is_near(std::size_t k, Pack squared) const {
    if constexpr (!own_reaches) return squared < squared_reach;
    Pack const both = reach + Pack::load(half_reach + k);
    return squared < both * both;
  }
};

#if defined(__AVX2__)
/// For every set of lanes, how to move them to the front.
struct Compaction {
  alignas(16) std::uint8_t bytes[16][16];
  constexpr Compaction() : bytes{} {
    for (unsigned set = 0; set < 16; ++set) {
      unsigned to = 0;
      for (unsigned lane = 0; lane < 4; ++lane) {
        if ((set >> lane & 1u) == 0) continue;
        for (unsigned b = 0; b < 4; ++b) bytes[set][4 * to + b] = static_cast<std::uint8_t>(4 * lane + b);
        ++to;
      }
    }
  }
};
inline constexpr Compaction compaction{};
#endif

template <int Dim, bool own_reaches>
SPHVERIFY_INLINE std::size_t list_candidates(Candidates const& all, double const* x, double reach,
                                             std::uint32_t* out, bool* same_place) {
  Nearness<Dim, own_reaches> const to(all, x, reach);
  std::uint32_t const* const particle = all.particle;
  std::size_t const count = all.count;
  std::uint32_t const* const start = out;
  Pack::Mask at{};
  for (std::size_t k = 0; k < count; k += Pack::size) {
    Pack const squared = to.squared_distance(k);
    Pack::Mask const near = to.is_near(k, squared);
    at |= squared.lanes == Pack(0.0).lanes;
#if defined(__AVX2__)
    unsigned const set = static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(near)));
    __m128i const four = _mm_loadu_si128(reinterpret_cast<__m128i const*>(particle + k));
    __m128i const how = _mm_load_si128(reinterpret_cast<__m128i const*>(compaction.bytes[set]));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm_shuffle_epi8(four, how));
    out += static_cast<unsigned>(__builtin_popcount(set));
#else
    // Written whether near or not, and kept by counting on: a branch would be mispredicted every fourth time.
    for (std::size_t l = 0; l < Pack::size; ++l) {
      *out = particle[k + l];
      out -= near[l];
    }
#endif
  }
  *same_place = (at[0] | at[1] | at[2] | at[3]) != 0;
  return static_cast<std::size_t>(out - start);
}

template <int Dim>
std::size_t list_near(Candidates const& all, double const* x, double reach, std::uint32_t* out,
                      bool* same_place) {
  return all.half_reach ? list_candidates<Dim, true>(all, x, reach, out, same_place)
                        : list_candidates<Dim, false>(all, x, reach, out, same_place);
}

template <int Dim>
constexpr ListKernels make_list_kernels() {
  return {.list_near = list_near<Dim>};
}

}  // namespace sphverify::SPHVERIFY_INSTRUCTION_SET
