#pragma once

#include <string_view>

namespace sphverify::exact {

// Each returns its value, so that a constructor can check what it stores, and throws std::invalid_argument
// with "QUANTITY must be ..., found VALUE" otherwise. NaN and infinities never pass.

double require_finite(std::string_view quantity, double value);
double require_positive(std::string_view quantity, double value);
double require_not_negative(std::string_view quantity, double value);
double require_above(std::string_view quantity, double value, double limit);

/// For whole numbers from 1 on.
int require_positive(std::string_view quantity, int value);

}  // namespace sphverify::exact
