#include "cases/exact/require.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace sphverify::exact {

namespace {

template <class Number>
[[noreturn]] void refuse(std::string_view quantity, std::string_view expected, Number const& found) {
  std::ostringstream message;
  message << quantity << " must be " << expected << ", found " << found;
  throw std::invalid_argument(message.str());
}

}  // namespace

double require_finite(std::string_view quantity, double value) {
  if (!std::isfinite(value)) refuse(quantity, "finite", value);
  return value;
}

double require_positive(std::string_view quantity, double value) {
  if (!(value > 0.0)) refuse(quantity, "positive", value);
  return require_finite(quantity, value);
}

double require_not_negative(std::string_view quantity, double value) {
  if (!(value >= 0.0)) refuse(quantity, "zero or positive", value);
  return require_finite(quantity, value);
}

double require_above(std::string_view quantity, double value, double limit) {
  if (!(value > limit)) {
    std::ostringstream expected;
    expected << "above " << limit;
    refuse(quantity, expected.str(), value);
  }
  return require_finite(quantity, value);
}

int require_positive(std::string_view quantity, int value) {
  if (value < 1) refuse(quantity, "1 or more", value);
  return value;
}

}  // namespace sphverify::exact
