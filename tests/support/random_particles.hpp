// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tuple>
#include <type_traits>

#include "harness/claims/random_scene.hpp"

// What the tests of the schemes start from beside harness/claims/random_scene.hpp; the expected values come from elsewhere.
namespace sphverify::tests {

using namespace sphverify::claims;

/// For BOOST_AUTO_TEST_CASE_TEMPLATE: `constexpr int Dim = D::value`.
using Dimensions = std::tuple<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                              std::integral_constant<int, 3>>;

/// The subsets of what a wall may prescribe, numbered 0 to 15.
inline BoundaryValueSet subset(unsigned number) {
  BoundaryValueSet values;
  if ((number & 1u) != 0) values.insert(BoundaryValue::pressure);
  if ((number & 2u) != 0) values.insert(BoundaryValue::velocity);
  if ((number & 4u) != 0) values.insert(BoundaryValue::temperature);
  if ((number & 8u) != 0) values.insert(BoundaryValue::flux);
  return values;
}

/// A row comes cell by cell; this is the set that it is.
inline std::vector<std::uint32_t> sorted_row(NeighbourList const& list, std::size_t i) {
  std::vector<std::uint32_t> row(list.row(i).begin(), list.row(i).end());
  std::sort(row.begin(), row.end());
  return row;
}

/// Bit for bit, where any two NaN count as equal.
inline bool same_bits(std::vector<double> const& a, std::vector<double> const& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] != b[i] && !(std::isnan(a[i]) && std::isnan(b[i]))) return false;
  }
  return true;
}

}  // namespace sphverify::tests
