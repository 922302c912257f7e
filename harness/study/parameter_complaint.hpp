// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cases/exact/bad_value.hpp"
#include "cases/support/case.hpp"
#include "reports/json/node.hpp"

namespace sphverify {

/// The parameter of a case that a bad value is of, without a place in it; empty if it follows from several.
std::string parameter_of(BadValue const& error, CaseInfo const& info);

/// What a case says of its parameters, told of the place in a user's document. prefix: what names of
/// parameters follow there, such as "cases[0].parameters."; given: those that were given, an object or null.
UserError parameter_complaint(BadValue const& error, CaseInfo const& info, std::string const& file,
                              std::string const& prefix, Json const* given);

}  // namespace sphverify
