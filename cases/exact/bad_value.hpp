// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace sphverify {

/// A value that makes no sense for a case, in the parts of which a message to the user is made. Where the
/// value is a parameter's, `quantity` is the name of that parameter, or a place in it such as modes[0][1].
class BadValue : public std::invalid_argument {
 public:
  /// found: empty where it is the value that the user gave.
  BadValue(std::string quantity, std::string expected, std::string found);

  std::string quantity, expected, found;
};

}  // namespace sphverify
