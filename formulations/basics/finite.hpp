// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sphverify {

/// Index of the first number that is NaN or infinite.
std::optional<std::size_t> first_not_finite(std::span<double const> values);

/// "WHAT of particle I is not finite", of the first that is not; empty if all are.
/// @param components lists of one value per particle each
std::string why_not_finite(std::string_view what, std::vector<std::span<double const>> const& components);

}  // namespace sphverify
