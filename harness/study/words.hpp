// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sphverify {

/// The words by which documents name the values of an enumeration.
template <class Enum, std::size_t Count>
struct Words {
  std::array<std::pair<std::string_view, Enum>, Count> entries;

  /// Expects one of the words; documents are checked against `all()` when they are read.
  constexpr Enum value(std::string_view word) const {
    for (auto const& [name, value] : entries) {
      if (name == word) return value;
    }
    throw std::invalid_argument("unknown word '" + std::string(word) + "'");
  }

  /// Expects one of the values.
  constexpr std::string_view word(Enum value) const {
    for (auto const& [name, known] : entries) {
      if (known == value) return name;
    }
    throw std::invalid_argument("a value without a word");
  }

  std::vector<std::string> all() const {
    std::vector<std::string> words;
    for (auto const& entry : entries) words.emplace_back(entry.first);
    return words;
  }
};

}  // namespace sphverify
