// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "cases/support/case.hpp"
#include "reports/json/node.hpp"

// Cases and their parameters as words of the command line.
namespace sphverify {

/// The case of an identifier. Throws UserError, which names the command and the nearest ones.
Case const& case_named(std::string const& command, std::string const& id);

/// NAME=VALUE for each, VALUE being JSON or a bare word. Throws UserError.
Parameters read_assignments(std::string const& command, CaseInfo const& info, std::vector<std::string> const& assignments);

/// The values of the assignments by name, for complaints.
Json assigned_values(std::vector<std::string> const& assignments);

}  // namespace sphverify
