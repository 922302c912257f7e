// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "reports/results.hpp"

namespace sphverify {

/// The name of this program: "sphverify" unless it was made by somebody else of our libraries.
std::string const& program_name();
void set_program_name(std::string_view name);

/// Notes that the program has a part that is not ours.
void note_added_part(std::string_view id);

/// Version, build, machine and date of this process.
Context current_context();

}  // namespace sphverify
