#pragma once

#include <cstdint>
#include <initializer_list>

namespace sphverify {

/// A small set over the values of an enumeration, usable in constant expressions.
template <class Enum>
class FlagSet {
 public:
  constexpr FlagSet() = default;
  constexpr FlagSet(std::initializer_list<Enum> flags) {
    for (Enum const flag : flags) insert(flag);
  }

  constexpr void insert(Enum flag) { bits_ |= bit(flag); }
  constexpr bool contains(Enum flag) const { return (bits_ & bit(flag)) != 0; }
  constexpr bool contains(FlagSet other) const { return (bits_ & other.bits_) == other.bits_; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr FlagSet operator|(FlagSet other) const { return FlagSet(bits_ | other.bits_); }
  constexpr bool operator==(FlagSet const&) const = default;

 private:
  constexpr explicit FlagSet(std::uint32_t bits) : bits_(bits) {}
  static constexpr std::uint32_t bit(Enum flag) { return std::uint32_t{1} << static_cast<unsigned>(flag); }

  std::uint32_t bits_ = 0;
};

}  // namespace sphverify
