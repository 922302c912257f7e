// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "reports/json/node.hpp"

namespace sphverify {

/// How far one list of somebody's rates is from ours.
struct RateComparison {
  std::string scheme, quantity;  ///< momentum/p-rho2, acceleration
  double l1 = 0.0, l2 = 0.0, linf = 0.0;  ///< of the differences over all particles, relative to our largest
  std::size_t worst = 0;                  ///< the particle of the largest difference
  std::vector<double> theirs{}, ours{};   ///< its rates
  std::string problem{};                  ///< why there are no numbers
  bool holds = false;                     ///< whether the largest difference is within the limit, or the rounding of what cancels
};

/// The schemes of a document of rates. Throws UserError.
std::set<std::string> schemes_in(Node const& theirs);

/// Compares every list of {"rates": {scheme: {quantity: [one number or vector per particle]}}} with ours of the same name.
/// @param ours as `evaluate_state` gives it
/// @param limit of the largest difference, relative to our largest rate
/// Throws UserError for lists that are none.
std::vector<RateComparison> compare_rates(Node const& theirs, Json const& ours, double limit);

Json to_json(RateComparison const& one);

}  // namespace sphverify
