// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/load_plugin.hpp"

#include <fmt/format.h>

#include "formulations/plugins/plugin_library.hpp"
#include "harness/study/context.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

std::string load_plugin_for_user(std::string const& path, std::string const& file, std::string const& key) {
  try {
    std::string const id = load_plugin(path);
    note_added_part(id);
    return id;
  } catch (BadPlugin const& error) {
    throw UserError(file, key, key.empty() ? error.found() : fmt::format("'{}', {}", path, error.found()),
                    error.expected());
  }
}

}  // namespace sphverify
