// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/require.hpp"

#include <cmath>
#include <sstream>

namespace sphverify::exact {

std::string brief(double value) {
  if (std::isnan(value)) return "no number";
  if (std::isinf(value)) return "an infinite number";
  std::ostringstream text;
  text << value;
  return text.str();
}

double require_finite(std::string_view quantity, double value) {
  if (!std::isfinite(value)) throw BadValue(std::string(quantity), "finite", brief(value));
  return value;
}

double require_positive(std::string_view quantity, double value) {
  if (!(value > 0.0)) throw BadValue(std::string(quantity), "positive", brief(value));
  return require_finite(quantity, value);
}

double require_not_negative(std::string_view quantity, double value) {
  if (!(value >= 0.0)) throw BadValue(std::string(quantity), "zero or positive", brief(value));
  return require_finite(quantity, value);
}

double require_above(std::string_view quantity, double value, double limit) {
  if (!(value > limit)) throw BadValue(std::string(quantity), "above " + brief(limit), brief(value));
  return require_finite(quantity, value);
}

int require_positive(std::string_view quantity, int value) {
  if (value < 1) throw BadValue(std::string(quantity), "1 or more", std::to_string(value));
  return value;
}

}  // namespace sphverify::exact
