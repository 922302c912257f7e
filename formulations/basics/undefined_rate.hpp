// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace sphverify {

/// A scheme met what it is not defined for, such as the square root of a negative pressure.
class UndefinedRate : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// It was particles' places: some have too few others around them, or all of them in one direction.
class TooFewPartners : public UndefinedRate {
 public:
  using UndefinedRate::UndefinedRate;
};

}  // namespace sphverify
