// SPDX-License-Identifier: GPL-3.0-or-later
#include <hwy/highway.h>

#include "bench/packs/columns.hpp"
#include "bench/packs/rows.hpp"

namespace sphverify::bench {

namespace hn = hwy::HWY_NAMESPACE;

/// The library's arithmetic; its loads of interleaved records take records that lie side by side.
template <class Lanes>
struct Highway {
  static constexpr std::size_t size = sizeof(Lanes) / sizeof(double);
  using Tag = hn::FixedTag<double, size>;
  using Vec = hn::Vec<Tag>;
  Vec vec;

  Highway() = default;
  __attribute__((always_inline)) explicit Highway(double all) : vec(hn::Set(Tag(), all)) {}
  __attribute__((always_inline)) Highway(Vec v) : vec(v) {}
  __attribute__((always_inline)) static void columns(double const* const* rows, Highway* to) {
    Lanes column[4];
    transpose(rows, column);
    for (std::size_t n = 0; n < 4; ++n) to[n].vec.raw = column[n];
  }
  __attribute__((always_inline)) friend Highway operator+(Highway a, Highway b) { return hn::Add(a.vec, b.vec); }
  __attribute__((always_inline)) friend Highway operator-(Highway a, Highway b) { return hn::Sub(a.vec, b.vec); }
  __attribute__((always_inline)) friend Highway operator*(Highway a, Highway b) { return hn::Mul(a.vec, b.vec); }
  __attribute__((always_inline)) friend Highway operator-(Highway a) { return hn::Neg(a.vec); }
  __attribute__((always_inline)) friend Highway max(Highway a, Highway b) { return hn::Max(a.vec, b.vec); }
  __attribute__((always_inline)) friend Highway sqrt(Highway a) { return hn::Sqrt(a.vec); }
  __attribute__((always_inline)) Highway first(std::size_t count) const {
    return hn::IfThenElseZero(hn::FirstN(Tag(), count), vec);
  }
  __attribute__((always_inline)) double sum() const { return hn::GetLane(hn::SumOfLanes(Tag(), vec)); }
};

}  // namespace sphverify::bench
