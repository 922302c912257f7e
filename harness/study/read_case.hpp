// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "harness/study/study.hpp"
#include "reports/json/node.hpp"

namespace sphverify {

/// One of the known identifiers. Throws UserError with the nearest one.
std::string read_identifier(Node const& node, std::vector<std::string> const& known,
                            char const* listing_command);

/// Drops the parameters that mean nothing beside the others. Throws BadValue for what makes no sense, what
/// was given and means nothing among it.
Parameters sensible(Case const& one, Parameters const& parameters);

/// A case of a study: an identifier, or an object with parameters. Throws UserError.
StudyCase read_case(Node const& node);

}  // namespace sphverify
