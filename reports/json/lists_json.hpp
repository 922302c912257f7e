// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "reports/json/node.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// JSON has no NaN and no infinity: what is not finite, or does not exist, is null.
Json number(double value);
Json number(Number const& value);
Json numbers(std::vector<double> const& values);
Json number_lists(std::vector<std::vector<double>> const& lists);

/// What `number` wrote: null is read as NaN. Throw UserError for anything else.
double measured(Node const& node);
std::vector<double> measured_list(Node const& node);
std::vector<std::vector<double>> measured_lists(Node const& node);

/// Lists by particle and over time, of one run.
Json to_json(Profile const& profile);
/// @param moves whether momentum and walls' defects are part of it
Json to_json(History const& history, bool moves);
Profile read_profile(Node const& node);
History read_history(Node const& node);

}  // namespace sphverify
