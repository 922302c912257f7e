#pragma once

#include <string_view>

namespace sphverify {

/// Takes a kernel's place in the loops over pairs where W'(r)/r is not computed but stored with the list, one number per
/// directed pair (NeighbourList::slope). There is no W then, and nothing ends at a support.
template <int Dim>
struct StoredSlope {
  static constexpr std::string_view id = "stored-slope";
  static constexpr double support_ratio = 1e60;  ///< its fourth power is a number still
};

template <class Kernel>
inline constexpr bool is_stored = false;
template <int Dim>
inline constexpr bool is_stored<StoredSlope<Dim>> = true;

}  // namespace sphverify
