// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <initializer_list>

namespace sphverify {

/// A small set over the values of an enumeration, usable in constant expressions and as a template argument.
template <class Enum>
class FlagSet {
 public:
  constexpr FlagSet() = default;
  constexpr FlagSet(std::initializer_list<Enum> flags) {
    for (Enum const flag : flags) insert(flag);
  }

  constexpr void insert(Enum flag) { bits |= bit(flag); }
  constexpr bool contains(Enum flag) const { return (bits & bit(flag)) != 0; }
  constexpr bool contains(FlagSet other) const { return (bits & other.bits) == other.bits; }
  constexpr bool empty() const { return bits == 0; }
  constexpr FlagSet operator|(FlagSet other) const { return FlagSet(bits | other.bits); }
  constexpr FlagSet without(FlagSet other) const { return FlagSet(bits & ~other.bits); }
  constexpr bool operator==(FlagSet const&) const = default;

  std::uint32_t bits = 0;  ///< public, since template arguments have no secrets

 private:
  constexpr explicit FlagSet(std::uint32_t all) : bits(all) {}
  static constexpr std::uint32_t bit(Enum flag) { return std::uint32_t{1} << static_cast<unsigned>(flag); }
};

}  // namespace sphverify
