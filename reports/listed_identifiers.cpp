// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/listed_identifiers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/user_error.hpp"

namespace sphverify {

std::string one_listed_by(std::string_view command, std::string_view found,
                          std::vector<std::string> identifiers) {
  constexpr std::size_t few = 3;
  std::vector<std::string> near;
  while (near.size() < few) {
    std::string const next = nearest(found, identifiers);
    if (next.empty()) break;
    std::erase(identifiers, next);
    near.push_back(next);
  }
  std::string text = fmt::format("one of `{}`", command);
  if (near.empty()) return text;
  text += fmt::format(" (did you mean '{}'?", near.front());
  if (near.size() > 1) text += fmt::format(" or {}", fmt::join(near.begin() + 1, near.end(), ", "));
  return text + ")";
}

}  // namespace sphverify
