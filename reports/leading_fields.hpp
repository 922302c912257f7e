// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace sphverify {

/// The field that a case is about is the first of these that it has.
inline constexpr std::array<char const*, 4> leading_fields{"temperature", "velocity", "acceleration",
                                                           "heating"};

}  // namespace sphverify
