// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/codes/snapshot.hpp"

namespace sphverify {

void keep_only(Snapshot& snapshot, std::vector<char> const& keep) {
  for (auto& [name, values] : snapshot.columns) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (keep[i]) values[kept++] = values[i];
    }
    values.resize(kept);
  }
}

}  // namespace sphverify
