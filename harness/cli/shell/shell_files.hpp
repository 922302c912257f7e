// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>

// What a shell's user has of the program beside it, made of what its commands and options say of themselves, so that a new
// option cannot be forgotten: pages for `man`, and completion.
namespace sphverify {

/// Of the program, or of one of its commands.
std::string manual_page(CLI::App const& command);

std::string bash_completion(CLI::App const& app);
std::string zsh_completion(CLI::App const& app);

}  // namespace sphverify
