// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/neighbours/locality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "formulations/basics/expects.hpp"

namespace sphverify {

namespace {

/// Bits of a cell's number along one axis that the curve heeds: beyond so many cells all count as the last.
template <int Dim>
constexpr int bits = Dim == 1 ? 53 : 63 / Dim;

/// The numbers of a cell along the axes with their bits in turn, the first axis' in front: its place along
/// the curve.
template <int Dim>
std::uint64_t interleave(std::array<std::uint64_t, Dim> const& cell) {
  std::uint64_t key = 0;
  for (int bit = bits<Dim> - 1; bit >= 0; --bit) {
    for (int k = 0; k < Dim; ++k) key = (key << 1) | ((cell[k] >> bit) & 1u);
  }
  return key;
}

}  // namespace

template <int Dim>
std::vector<std::uint32_t> locality_order(VectorField<Dim> const& positions, Domain<Dim> const& domain,
                                          double cell) {
  expects(cell > 0.0);
  expects(positions.size() <= std::numeric_limits<std::uint32_t>::max());
  Vector<Dim> lowest = Vector<Dim>::Constant(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < positions.size(); ++i) lowest = lowest.cwiseMin(domain.to_box(positions[i]));

  constexpr double last = static_cast<double>((std::uint64_t{1} << bits<Dim>)-1);
  std::vector<std::uint64_t> keys(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    Vector<Dim> const from_lowest = domain.to_box(positions[i]) - lowest;
    std::array<std::uint64_t, Dim> at{};
    for (int k = 0; k < Dim; ++k) {
      // Written so that no coordinate, not even NaN, becomes a number that the integer cannot hold.
      double const number = from_lowest[k] / cell;
      if (number > 0.0) at[k] = static_cast<std::uint64_t>(std::min(number, last));
    }
    keys[i] = interleave<Dim>(at);
  }
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t i, std::uint32_t j) { return keys[i] < keys[j]; });
  return order;
}

template std::vector<std::uint32_t> locality_order(VectorField<1> const&, Domain<1> const&, double);
template std::vector<std::uint32_t> locality_order(VectorField<2> const&, Domain<2> const&, double);
template std::vector<std::uint32_t> locality_order(VectorField<3> const&, Domain<3> const&, double);

}  // namespace sphverify
