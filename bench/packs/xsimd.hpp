// SPDX-License-Identifier: GPL-3.0-or-later
#include <xsimd/xsimd.hpp>

#include "bench/packs/columns.hpp"
#include "bench/packs/rows.hpp"

namespace sphverify::bench {

/// The library's arithmetic; it has no function that transposes records.
template <class Lanes, class Architecture>
struct Xsimd {
  using Batch = xsimd::batch<double, Architecture>;
  static constexpr std::size_t size = Batch::size;
  Batch batch;

  Xsimd() = default;
  __attribute__((always_inline)) explicit Xsimd(double all) : batch(all) {}
  __attribute__((always_inline)) Xsimd(Batch b) : batch(b) {}
  __attribute__((always_inline)) static void columns(double const* const* rows, Xsimd* to) {
    Lanes column[4];
    transpose(rows, column);
    for (std::size_t n = 0; n < 4; ++n) to[n] = Batch(typename Batch::register_type(column[n]));
  }
  __attribute__((always_inline)) friend Xsimd operator+(Xsimd a, Xsimd b) { return a.batch + b.batch; }
  __attribute__((always_inline)) friend Xsimd operator-(Xsimd a, Xsimd b) { return a.batch - b.batch; }
  __attribute__((always_inline)) friend Xsimd operator*(Xsimd a, Xsimd b) { return a.batch * b.batch; }
  __attribute__((always_inline)) friend Xsimd operator-(Xsimd a) { return -a.batch; }
  __attribute__((always_inline)) friend Xsimd max(Xsimd a, Xsimd b) { return xsimd::max(a.batch, b.batch); }
  __attribute__((always_inline)) friend Xsimd sqrt(Xsimd a) { return xsimd::sqrt(a.batch); }
  __attribute__((always_inline)) Xsimd first(std::size_t count) const {
    alignas(64) double number[size];
    for (std::size_t l = 0; l < size; ++l) number[l] = static_cast<double>(l);
    return xsimd::select(Batch::load_aligned(number) < Batch(static_cast<double>(count)), batch, Batch(0.0));
  }
  __attribute__((always_inline)) double sum() const { return xsimd::hadd(batch); }
};

}  // namespace sphverify::bench
