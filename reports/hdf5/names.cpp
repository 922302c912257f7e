// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/hdf5/names.hpp"

#include <fmt/format.h>

#include <charconv>

namespace sphverify::hdf5 {

std::string name_of_key(std::string_view key) {
  if (key.empty()) return "%";
  if (key == ".") return "%2e";
  std::string name;
  for (char const c : key) {
    if (c == '/' || c == '@' || c == '%' || c == '\0') {
      name += fmt::format("%{:02x}", static_cast<unsigned>(c));
    } else {
      name += c;
    }
  }
  return name;
}

std::string key_of_name(std::string_view name) {
  if (name == "%") return "";
  std::string key;
  for (std::size_t at = 0; at < name.size(); ++at) {
    unsigned code = 0;
    bool const is_code = name[at] == '%' && at + 2 < name.size() &&
                         std::from_chars(name.data() + at + 1, name.data() + at + 3, code, 16).ptr == name.data() + at + 3;
    key += is_code ? static_cast<char>(code) : name[at];
    if (is_code) at += 2;
  }
  return key;
}

}  // namespace sphverify::hdf5
