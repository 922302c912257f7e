// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace sphverify {

/// load_plugin, with what is wrong as a UserError of that file and key. Returns plugin/NAME.
std::string load_plugin_for_user(std::string const& path, std::string const& file, std::string const& key);

}  // namespace sphverify
