#include "harness/study/load_plugin.hpp"

#include <fmt/format.h>

#include "formulations/plugins/plugin_library.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

std::string load_plugin_for_user(std::string const& path, std::string const& file, std::string const& key) {
  try {
    return load_plugin(path);
  } catch (BadPlugin const& error) {
    throw UserError(file, key, key.empty() ? error.found() : fmt::format("'{}', {}", path, error.found()),
                    error.expected());
  }
}

}  // namespace sphverify
