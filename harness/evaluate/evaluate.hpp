// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>

#include "reports/json/node.hpp"

namespace sphverify {

/// The rates of every scheme on the particles of a state document (sphverify-state/1), with and without wall
/// terms: the document sphverify-rates/1. A scheme is left out where the state lacks a field that it reads;
/// one that is undefined on the state has null rates and a reason. With a viscosity, what it adds stands under
/// `viscosity/monaghan` or `viscosity/riemann`. Throws UserError.
/// @param only identifiers of those that are wanted; empty: all
Json evaluate_state(Node const& state, std::set<std::string> const& only = {});

}  // namespace sphverify
