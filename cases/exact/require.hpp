// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "cases/exact/bad_value.hpp"

namespace sphverify::exact {

// Each returns its value, so that a constructor can check what it stores, and throws BadValue otherwise. NaN
// and infinities never pass.

double require_finite(std::string_view quantity, double value);
double require_positive(std::string_view quantity, double value);
double require_not_negative(std::string_view quantity, double value);
double require_above(std::string_view quantity, double value, double limit);

/// For whole numbers from 1 on.
int require_positive(std::string_view quantity, int value);

/// A number for a message, in six digits; in words what is none.
std::string brief(double value);

}  // namespace sphverify::exact
