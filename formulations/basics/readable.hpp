#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace sphverify {

/// A number for messages, of any size: six digits.
inline std::string readable(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", number);
  return text.data();
}

}  // namespace sphverify
