// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace sphverify {

/// Text of a file of the report's page as it was when the program was built, by its path below reports/page;
/// "licences" holds those of the libraries. Empty where there was no such file.
std::string_view page_resource(std::string_view name);

}  // namespace sphverify
