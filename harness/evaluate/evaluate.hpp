#pragma once

#include "reports/json/node.hpp"

namespace sphverify {

/// The rates of every scheme on the particles of a state document (sphverify-state/1), with and without wall
/// terms: the document sphverify-rates/1. A scheme is left out where the state lacks a field that it reads;
/// one that is undefined on the state has null rates and a reason. Throws UserError.
Json evaluate_state(Node const& state);

}  // namespace sphverify
