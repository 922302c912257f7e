// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/basics/finite.hpp"

#include <algorithm>
#include <cmath>

namespace sphverify {

std::optional<std::size_t> first_not_finite(std::span<double const> values) {
  auto const found =
      std::find_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
  if (found == values.end()) return std::nullopt;
  return static_cast<std::size_t>(found - values.begin());
}

std::string why_not_finite(std::string_view what, std::vector<std::span<double const>> const& components) {
  std::optional<std::size_t> first;
  for (auto const& component : components) {
    auto const found = first_not_finite(component);
    if (found && (!first || *found < *first)) first = found;
  }
  return first ? std::string(what) + " of particle " + std::to_string(*first) + " is not finite" : "";
}

}  // namespace sphverify
