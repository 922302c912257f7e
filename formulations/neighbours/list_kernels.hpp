// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/neighbours/candidates.hpp"
#include "formulations/simd/eight.hpp"

// The loops that find neighbours. Included by the files that are compiled once per instruction set, and by
// nothing else.
namespace sphverify::SPHVERIFY_INSTRUCTION_SET {

static_assert(Eight::size == candidates_at_a_time);

/// What a pair's reach is made of: nothing of its own, the sum of its halves, or the larger.
enum class Reach { common, of_sum, of_larger };

SPHVERIFY_INLINE Reach reach_of(SortedPlaces const& all) {
  if (!all.half_reach) return Reach::common;
  return all.support == PairSupport::mean ? Reach::of_sum : Reach::of_larger;
}

template <Reach reach>
SPHVERIFY_INLINE Eight whole_reach(Eight a, Eight b) {
  if constexpr (reach == Reach::of_larger) {
    Eight const larger = a + positive_part(b - a);
    return larger + larger;
  } else {
    return a + b;
  }
}

template <int Dim, Reach reach>
SPHVERIFY_INLINE void add_candidates(SortedPlaces const& all, HomeBox const& home, std::size_t begin,
                                     std::size_t end, double const* shift, Candidates& to) {
  Eight::Mask const lane{0, 1, 2, 3, 4, 5, 6, 7};
  std::size_t count = to.count;
  for (std::size_t n = begin; n < end; n += Eight::size) {
    Eight x[Dim];
    Eight squared = 0.0f;  // distance from the home box
    for (std::size_t k = 0; k < Dim; ++k) {
      x[k] = Eight::load(all.x[k] + n, shift[k], home.centre[k], home.per_reach);
      Eight const beyond = positive_part(magnitude(x[k]) - home.half_extent[k]);
      squared = squared + beyond * beyond;
    }
    Eight half_reach = 0.5f;
    if constexpr (reach != Reach::common) half_reach = Eight::load(all.half_reach + n, 0.0, 0.0, home.per_reach);
    Eight const farthest = whole_reach<reach>(half_reach, home.largest_half_reach);
    Eight::Mask left_out = squared > farthest * farthest + home.margin;
    left_out |= lane >= static_cast<std::int32_t>(end - n < Eight::size ? end - n : Eight::size);
    unsigned const set = ~bits_of(left_out) & 0xffu;
    ToFront const front(set);
    for (std::size_t k = 0; k < Dim; ++k) front.store(x[k], to.x[k] + count);
    if constexpr (reach != Reach::common) front.store(half_reach, to.half_reach + count);
    front.store(all.number + n, to.number + count);
    std::uint32_t places[Eight::size];
    for (std::size_t l = 0; l < Eight::size; ++l) places[l] = static_cast<std::uint32_t>(n + l);
    front.store(places, to.place + count);
    count += static_cast<unsigned>(__builtin_popcount(set));
  }
  to.count = count;
}

template <int Dim>
void add(SortedPlaces const& all, HomeBox const& home, std::size_t begin, std::size_t end,
         double const* shift, Candidates& to) {
  switch (reach_of(all)) {
    case Reach::common:
      return add_candidates<Dim, Reach::common>(all, home, begin, end, shift, to);
    case Reach::of_sum:
      return add_candidates<Dim, Reach::of_sum>(all, home, begin, end, shift, to);
    case Reach::of_larger:
      return add_candidates<Dim, Reach::of_larger>(all, home, begin, end, shift, to);
  }
}

/// Which candidates of eight are near, in double precision.
/// @param at the first of the eight
/// @param asked which of them
template <int Dim, Reach reach>
[[gnu::noinline, gnu::cold]] unsigned confirm(SortedPlaces const& all, Candidates const& candidates,
                                              std::size_t self, double common_reach, std::size_t at, unsigned asked,
                                              bool& same_place) {
  std::size_t const i = candidates.place[self];
  unsigned near = 0;
  for (std::size_t l = 0; l < Eight::size; ++l) {
    std::size_t const n = at + l;
    if ((asked >> l & 1u) == 0 || n >= candidates.count || n == self) continue;
    CandidateRun const* run = candidates.runs + (candidates.run_count - 1);
    while (run->first > n) --run;
    std::size_t const j = candidates.place[n];
    double squared = 0.0;
    for (std::size_t k = 0; k < Dim; ++k) {
      double const along = all.x[k][i] - (all.x[k][j] + run->shift[k]);
      squared += along * along;
    }
    double both = common_reach;
    if constexpr (reach == Reach::of_sum) both = all.half_reach[i] + all.half_reach[j];
    if constexpr (reach == Reach::of_larger)
      both = 2.0 * (all.half_reach[i] < all.half_reach[j] ? all.half_reach[j] : all.half_reach[i]);
    if (squared < both * both) near |= 1u << l;
    same_place |= squared == 0.0;
  }
  return near;
}

template <int Dim, Reach reach>
SPHVERIFY_INLINE std::size_t find_near_candidates(SortedPlaces const& all, HomeBox const& home,
                                                  Candidates const& candidates, std::size_t self,
                                                  double common_reach, std::uint8_t* near, bool& same_place) {
  // Copies: writing bytes must not make it read them anew.
  float const* x[Dim];
  Eight from[Dim];
  for (std::size_t k = 0; k < Dim; ++k) {
    x[k] = candidates.x[k];
    from[k] = x[k][self];
  }
  float const* const half_reach = candidates.half_reach;
  Eight const own_half_reach = reach != Reach::common ? half_reach[self] : 0.0f;
  float const margin = home.margin;
  Eight squared_reach = 1.0f;
  Eight::Mask at_place{};  // minus the number of those at the very place, as it rounds
  std::size_t found = 0;
  std::size_t const count = candidates.count;
  std::uint8_t* out = near;
  for (std::size_t n = 0; n < count; n += Eight::size) {
    Eight squared = 0.0f;
    for (std::size_t k = 0; k < Dim; ++k) {
      Eight const along = from[k] - Eight::load(x[k] + n);
      squared = squared + along * along;
    }
    if constexpr (reach != Reach::common) {
      Eight const both = whole_reach<reach>(own_half_reach, Eight::load(half_reach + n));
      squared_reach = both * both;
    }
    // What is neither, or no number, is looked at again.
    Eight::Mask const surely_near = squared < squared_reach - margin;
    Eight::Mask const surely_far = squared > squared_reach + margin;
    at_place += squared == Eight(0.0f);
    unsigned set = bits_of(surely_near);
    unsigned const known = bits_of(surely_near | surely_far);
    if (known != 0xffu) [[unlikely]] {
      set |= confirm<Dim, reach>(all, candidates, self, common_reach, n, ~known, same_place);
    }
    found += static_cast<unsigned>(__builtin_popcount(set));
    *out++ = static_cast<std::uint8_t>(set);
  }
  for (; (out - near) % 8 != 0; ++out) *out = 0;

  unsigned const own_bit = near[self / Eight::size] & 1u << self % Eight::size;
  near[self / Eight::size] = static_cast<std::uint8_t>(near[self / Eight::size] - own_bit);
  if (own_bit != 0) --found;
  int others_at_place = -1;
  for (std::size_t l = 0; l < Eight::size; ++l) others_at_place -= at_place[l];
  if (others_at_place > 0) [[unlikely]] {
    for (std::size_t n = 0; n < count; n += Eight::size) {
      confirm<Dim, reach>(all, candidates, self, common_reach, n, near[n / Eight::size], same_place);
    }
  }
  return found;
}

template <int Dim>
std::size_t find_near(SortedPlaces const& all, HomeBox const& home, Candidates const& candidates,
                      std::size_t self, double reach, std::uint8_t* near, bool& same_place) {
  switch (reach_of(all)) {
    case Reach::common:
      return find_near_candidates<Dim, Reach::common>(all, home, candidates, self, reach, near, same_place);
    case Reach::of_sum:
      return find_near_candidates<Dim, Reach::of_sum>(all, home, candidates, self, reach, near, same_place);
    case Reach::of_larger:
      return find_near_candidates<Dim, Reach::of_larger>(all, home, candidates, self, reach, near, same_place);
  }
  return 0;
}

inline void list(std::uint32_t const* number, std::uint8_t const* set, std::uint32_t* out,
                 std::uint32_t* end) {
  for (; end - out >= static_cast<std::ptrdiff_t>(Eight::size); ++set, number += Eight::size) {
    ToFront(*set).store(number, out);
    out += static_cast<unsigned>(__builtin_popcount(*set));
  }
  for (; out < end; ++set, number += Eight::size) {
    std::uint32_t last[Eight::size];
    ToFront(*set).store(number, last);
    for (int l = 0; l < __builtin_popcount(*set); ++l) *out++ = last[l];
  }
}

template <int Dim>
constexpr ListKernels make_list_kernels() {
  return {.add = add<Dim>, .find_near = find_near<Dim>, .list = list};
}

}  // namespace sphverify::SPHVERIFY_INSTRUCTION_SET
