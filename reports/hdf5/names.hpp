// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

// Names in a file of columns.
namespace sphverify::hdf5 {

/// Most objects and lists inside each other.
inline constexpr int deepest = 64;

/// What stands beside the values of a list, or of what has gaps; of a list in lists once for each.
inline std::string beside(std::string const& name, char const* what, int lists) {
  return name + "@" + what + (lists == 0 ? "" : std::to_string(lists));
}

inline std::string starts_of(std::string const& name, int lists) { return beside(name, "starts", lists); }
inline std::string missing_of(std::string const& name, int lists) { return beside(name, "missing", lists); }

/// A key as a name that HDF5 takes: without '/' and zeros, neither empty nor a dot alone, and without our own '@'.
std::string name_of_key(std::string_view key);
std::string key_of_name(std::string_view name);

}  // namespace sphverify::hdf5
