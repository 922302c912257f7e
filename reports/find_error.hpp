// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "reports/results.hpp"

namespace sphverify {

/// A run's error of a field in a region; null where it has none.
inline RegionError const* find_error(RunRecord const& run, std::string const& field, std::string const& region) {
  auto const regions = run.errors.find(field);
  if (regions == run.errors.end()) return nullptr;
  auto const error = regions->second.find(region);
  return error == regions->second.end() ? nullptr : &error->second;
}

}  // namespace sphverify
