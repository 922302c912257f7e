// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "bench/packs/columns.hpp"
#include "bench/packs/rows.hpp"

// As formulations/simd/pack.hpp has it, of any width.
namespace sphverify::bench {

template <class Lanes>
struct Ours {
  static constexpr std::size_t size = sizeof(Lanes) / sizeof(double);
  Lanes lanes;

  Ours() = default;
  __attribute__((always_inline)) explicit Ours(double all) : lanes(Lanes{} + all) {}
  __attribute__((always_inline)) Ours(Lanes l) : lanes(l) {}
  __attribute__((always_inline)) static void columns(double const* const* rows, Ours* to) {
    Lanes column[4];
    transpose(rows, column);
    for (std::size_t n = 0; n < 4; ++n) to[n] = column[n];
  }
  __attribute__((always_inline)) friend Ours operator+(Ours a, Ours b) { return a.lanes + b.lanes; }
  __attribute__((always_inline)) friend Ours operator-(Ours a, Ours b) { return a.lanes - b.lanes; }
  __attribute__((always_inline)) friend Ours operator*(Ours a, Ours b) { return a.lanes * b.lanes; }
  __attribute__((always_inline)) friend Ours operator-(Ours a) { return -a.lanes; }
  __attribute__((always_inline)) friend Ours max(Ours a, Ours b) { return a.lanes < b.lanes ? b.lanes : a.lanes; }
  __attribute__((always_inline)) friend Ours sqrt(Ours a) {
    Lanes root;
    for (std::size_t l = 0; l < size; ++l) root[l] = __builtin_sqrt(a.lanes[l]);
    return root;
  }
  __attribute__((always_inline)) Ours first(std::size_t count) const {
    Lanes number{};
    for (std::size_t l = 0; l < size; ++l) number[l] = static_cast<double>(l);
    return number < static_cast<double>(count) ? lanes : Lanes{};
  }
  __attribute__((always_inline)) double sum() const {
    double total = 0.0;
    for (std::size_t l = 0; l < size; ++l) total += lanes[l];
    return total;
  }
};

}  // namespace sphverify::bench
