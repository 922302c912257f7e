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

/// Version, build and parts of this program.
Context build_context();

/// Release, Debug, ...; "none" where CMake was not told.
std::string_view build_type();

/// Of the sources, as 2026-12-01; empty where it is not known.
std::string_view build_date();

/// The same, with machine and date of this process. The date is what SOURCE_DATE_EPOCH says, else that of the clock.
/// Throws UserError where it says no time.
Context current_context();

}  // namespace sphverify
