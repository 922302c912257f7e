// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sphverify {

/// The user's input is wrong: one line that says where, what was found and what was expected, made printable
/// whatever the input holds. Exit status 2.
class UserError : public std::runtime_error {
 public:
  explicit UserError(std::string_view message);
  /// "FILE: KEY: found FOUND, expected EXPECTED"
  UserError(std::string_view file, std::string_view key, std::string_view found, std::string_view expected);
};

/// The candidate that differs from a word by the fewest edits, or an empty string if none is near.
std::string nearest(std::string_view word, std::vector<std::string> const& candidates);

/// "one of a, b, c", with the nearest to what was found named.
std::string one_of(std::string_view found, std::vector<std::string> const& candidates);

}  // namespace sphverify
