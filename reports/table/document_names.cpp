// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/document_names.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

namespace sphverify {

namespace {

/// The last parts of a path, without the file's ending.
std::string tail(std::filesystem::path const& path, std::size_t parts) {
  std::vector<std::string> all;
  for (auto const& part : path.parent_path()) all.push_back(part.string());
  std::filesystem::path result = path.stem();
  for (std::size_t k = 1; k < parts && k <= all.size(); ++k) result = all[all.size() - k] / result;
  return result.string();
}

}  // namespace

std::vector<std::string> document_names(std::vector<std::string> const& paths) {
  std::vector<std::string> names(paths.size());
  std::vector<std::size_t> parts(paths.size(), 1);
  constexpr std::size_t deepest = 64;
  for (std::size_t round = 0; round < deepest; ++round) {
    for (std::size_t k = 0; k < paths.size(); ++k) names[k] = tail(paths[k], parts[k]);
    std::vector<std::size_t> longer = parts;
    for (std::size_t k = 0; k < paths.size(); ++k) {
      for (std::size_t other = 0; other < paths.size(); ++other) {
        if (names[other] == names[k] && paths[other] != paths[k]) longer[k] = parts[k] + 1;
      }
    }
    if (longer == parts) break;
    parts = longer;
  }
  std::multiset<std::string> seen;
  for (std::string& name : names) {
    seen.insert(name);
    if (seen.count(name) > 1) name += " (" + std::to_string(seen.count(name)) + ")";
  }
  return names;
}

}  // namespace sphverify
