// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "reports/json/node.hpp"
#include "reports/results.hpp"

namespace sphverify {

// Values of a results document, which somebody may have edited. Each throws UserError for what none can be.

Number optional_number(Node const& node);
std::string optional_string(Node const& node);
std::uint64_t count(Node const& node);
int read_resolution(Node const& node);

/// What is never below 0; null is NaN.
double size_of(Node const& node);
Number optional_size(Node const& node);

/// Empty in documents of versions that did not measure it.
Number found_number(Node const& node, char const* key);

/// [lower, upper], in this order.
std::pair<double, double> read_ends(Node const& node);

/// Median and interval of timings, in this order; empty in documents of versions that did not measure them.
MedianSeconds read_median(Node const& node);

/// One number for each norm.
NormSet read_sizes(Node const& node);
/// The norms of a field: l1 <= l2 <= linf, but for rounding.
NormSet read_norms(Node const& node);

}  // namespace sphverify
